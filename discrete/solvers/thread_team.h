// diptych: a few threads that work in lockstep, and the processes that sweep with them
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "discrete/solvers/processes.h"

namespace diptych::discrete
{
  // Threads 0 .. size()-1; thread 0 is the caller. Waiting threads first spin, then yield, and sleep between runs.
  class ThreadTeam
  {
  public:
    // Throws std::runtime_error if the system starts fewer threads.
    explicit ThreadTeam(int size, Processes &processes = only_process());
    ~ThreadTeam();
    ThreadTeam(const ThreadTeam &)            = delete;
    ThreadTeam &operator=(const ThreadTeam &) = delete;

    int        size() const { return int(workers_.size()) + 1; }
    Processes &processes() const { return processes_; }

    void run(const std::function<void(int)> &work);

    void barrier();

    template <class Done> static void wait_until(const Done &done) { (void)wait_awake(done, for_ever); }

  private:
    static constexpr long for_ever = 1L << 62;

    void serve(int rank);
    void end();

    // Spins, then yields, until done() holds or `patience` rounds are over. Returns done().
    template <class Done> static bool wait_awake(const Done &done, const long patience)
    {
      constexpr long spins = 200;
      for (long k = 0; k < patience; ++k)
        {
          if (done())
            return true;
          if (k >= spins)
            std::this_thread::yield();
        }
      return done();
    }

    Processes                      &processes_;
    std::vector<std::thread>        workers_;
    const std::function<void(int)> *work_ = nullptr;
    std::mutex                      mutex_;
    std::condition_variable         wake_;
    std::atomic<long>               round_{0}, generation_{0};
    std::atomic<int>                finished_{0}, arrived_{0};
    std::atomic<bool>               ending_{false};
  };
} // namespace diptych::discrete
