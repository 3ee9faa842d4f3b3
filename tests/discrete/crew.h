// diptych: processes that sweep together, here as threads of one process
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "discrete/solvers/processes.h"

namespace diptych::tests
{
  // Runs work(processes of rank 0), work(processes of rank 1), ... at the same time.
  class Crew
  {
  public:
    explicit Crew(const int size)
        : size_(size)
    {}

    void run(const std::function<void(discrete::Processes &)> &work)
    {
      std::vector<std::thread> members;
      for (int rank = 0; rank < size_; ++rank)
        members.emplace_back([this, rank, &work] {
          Member member(*this, rank);
          work(member);
        });
      for (std::thread &member : members)
        member.join();
    }

    long messages() const { return messages_; }

  private:
    class Member : public discrete::Processes
    {
    public:
      Member(Crew &crew, const int rank)
          : crew_(crew),
            rank_(rank)
      {}

      int rank() const override { return rank_; }
      int size() const override { return crew_.size_; }

      void send(const int to, const std::vector<double> &values) override
      {
        const std::lock_guard lock(crew_.mutex_);
        crew_.sent_[{rank_, to}].push_back(values);
        ++crew_.messages_;
        crew_.news_.notify_all();
      }

      void receive(const int from, std::vector<double> &values) override
      {
        std::unique_lock lock(crew_.mutex_);
        auto            &waiting = crew_.sent_[{from, rank_}];
        crew_.news_.wait(lock, [&] { return !waiting.empty(); });
        values = waiting.front();
        waiting.pop_front();
      }

      void gather(std::vector<double> &values, const std::vector<int> &counts) override
      {
        crew_.meet([&] { crew_.gathered_.resize(values.size()); });
        std::size_t begin = 0;
        for (int process = 0; process < rank_; ++process)
          begin += std::size_t(counts[process]);
        std::copy_n(values.begin() + begin, counts[rank_], crew_.gathered_.begin() + begin);
        crew_.meet([] {});
        values = crew_.gathered_;
        crew_.meet([] {});
      }

      int of_first(const int number) override
      {
        std::vector<double> values(std::size_t(crew_.size_), double(number));
        gather(values, std::vector<int>(std::size_t(crew_.size_), 1));
        return int(values[0]);
      }

    private:
      Crew &crew_;
      int   rank_;
    };

    // Waits until all are here; the last one acts first.
    void meet(const std::function<void()> &act)
    {
      std::unique_lock lock(mutex_);
      const long       turn = turn_;
      if (++arrived_ == size_)
        {
          act();
          arrived_ = 0;
          ++turn_;
          news_.notify_all();
        }
      else
        news_.wait(lock, [&] { return turn_ != turn; });
    }

    const int                                                      size_;
    std::mutex                                                     mutex_;
    std::condition_variable                                        news_;
    std::map<std::pair<int, int>, std::deque<std::vector<double>>> sent_;
    std::vector<double>                                            gathered_;
    int                                                            arrived_ = 0;
    long                                                           turn_ = 0, messages_ = 0;
  };
} // namespace diptych::tests
