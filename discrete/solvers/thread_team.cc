// diptych: a few threads that work in lockstep
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/solvers/thread_team.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <system_error>

namespace diptych::discrete
{
  namespace
  {
    constexpr long before_sleep = 2000;
  } // namespace

  ThreadTeam::ThreadTeam(const int size, Processes &processes)
      : processes_(processes)
  {
    workers_.reserve(std::size_t(std::max(0, size - 1)));
    for (int rank = 1; rank < size; ++rank)
      try
        {
          workers_.emplace_back([this, rank] { serve(rank); });
        }
      catch (const std::system_error &error)
        {
          end();
          throw std::runtime_error("cannot start " + std::to_string(size) + " threads: the system allows " +
                                   std::to_string(rank) + " (--threads): " + error.code().message());
        }
  }

  ThreadTeam::~ThreadTeam()
  {
    end();
  }

  void ThreadTeam::end()
  {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ending_ = true;
    }
    wake_.notify_all();
    for (std::thread &worker : workers_)
      worker.join();
  }

  void ThreadTeam::serve(const int rank)
  {
    for (long seen = 0;; ++seen)
      {
        const auto called = [&] { return ending_.load() || round_.load() > seen; };
        if (!wait_awake(called, before_sleep))
          {
            std::unique_lock<std::mutex> lock(mutex_);
            wake_.wait(lock, called);
          }
        if (ending_.load())
          return;
        (*work_)(rank);
        ++finished_;
      }
  }

  void ThreadTeam::run(const std::function<void(int)> &work)
  {
    if (workers_.empty())
      {
        work(0);
        return;
      }
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      work_     = &work;
      finished_ = 0;
      ++round_;
    }
    wake_.notify_all();
    work(0);
    wait_awake([this] { return finished_.load() == int(workers_.size()); }, for_ever);
  }

  void ThreadTeam::barrier()
  {
    if (workers_.empty())
      return;
    const long generation = generation_.load();
    if (++arrived_ == size())
      {
        arrived_ = 0;
        ++generation_;
      }
    else
      wait_awake([&] { return generation_.load() != generation; }, for_ever);
  }
} // namespace diptych::discrete
