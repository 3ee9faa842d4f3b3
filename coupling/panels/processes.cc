// diptych: helpers for several MPI processes that run one scene together
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/panels/processes.h"

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include <mpi.h>

#include "coupling/processes/stop_signal.h"
#include "discrete/solvers/thread_team.h"

namespace diptych::coupling
{
  namespace
  {
    enum class Failure
    {
      none,
      input,
      invariant,
      stopped,
      other
    };

    Failure kind_of(const std::exception &error)
    {
      if (dynamic_cast<const std::invalid_argument *>(&error) != nullptr)
        return Failure::input;
      if (dynamic_cast<const StoppedOnRequest *>(&error) != nullptr)
        return Failure::stopped;
      return dynamic_cast<const std::logic_error *>(&error) != nullptr ? Failure::invariant : Failure::other;
    }

    [[noreturn]] void throw_as(const Failure kind, const std::string &text)
    {
      if (kind == Failure::input)
        throw std::invalid_argument(text);
      if (kind == Failure::invariant)
        throw std::logic_error(text);
      if (kind == Failure::stopped)
        throw StoppedOnRequest(text);
      throw std::runtime_error(text);
    }

    int size_of(const MPI_Comm communicator)
    {
      int size = 1;
      MPI_Comm_size(communicator, &size);
      return size;
    }

    int rank_in(const MPI_Comm communicator)
    {
      int rank = 0;
      MPI_Comm_rank(communicator, &rank);
      return rank;
    }

    template <class Values> Values broadcast(Values values, const MPI_Datatype type)
    {
      int n = int(values.size());
      MPI_Bcast(&n, 1, MPI_INT, 0, MPI_COMM_WORLD);
      values.resize(std::size_t(n));
      MPI_Bcast(values.data(), n, type, 0, MPI_COMM_WORLD);
      return values;
    }

    // Any thread may send and receive, but MPI was started for one thread at a time.
    class MpiProcesses : public discrete::Processes
    {
    public:
      MpiProcesses()
          : rank_(rank_in(MPI_COMM_WORLD)),
            size_(size_of(MPI_COMM_WORLD)),
            sent_(std::size_t(size_))
      {
        MPI_Comm_dup(MPI_COMM_WORLD, &communicator_);
      }

      int rank() const override { return rank_; }
      int size() const override { return size_; }

      void send(const int to, const std::vector<double> &values) override
      {
        Message &message = sent_[to];
        wait_for(message.request);
        message.values = values;
        const std::lock_guard lock(mutex_);
        MPI_Isend(message.values.data(), int(values.size()), MPI_DOUBLE, to, 0, communicator_, &message.request);
      }

      void receive(const int from, std::vector<double> &values) override
      {
        MPI_Request request = MPI_REQUEST_NULL;
        {
          const std::lock_guard lock(mutex_);
          MPI_Irecv(values.data(), int(values.size()), MPI_DOUBLE, from, 0, communicator_, &request);
        }
        wait_for(request);
      }

      void gather(std::vector<double> &values, const std::vector<int> &counts) override
      {
        std::vector<int> begin(counts.size(), 0);
        std::partial_sum(counts.begin(), counts.end() - 1, begin.begin() + 1);
        MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, values.data(), counts.data(), begin.data(), MPI_DOUBLE, communicator_);
      }

      int of_first(int number) override
      {
        MPI_Bcast(&number, 1, MPI_INT, 0, communicator_);
        return number;
      }

    private:
      struct Message
      {
        std::vector<double> values;
        MPI_Request         request = MPI_REQUEST_NULL;
      };

      void wait_for(MPI_Request &request)
      {
        discrete::ThreadTeam::wait_until([&] {
          const std::lock_guard lock(mutex_);
          int                   arrived = 0;
          MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
          return arrived != 0;
        });
      }

      const int            rank_, size_;
      MPI_Comm             communicator_ = MPI_COMM_NULL; // lives as long as the job
      std::mutex           mutex_;
      std::vector<Message> sent_; // the last one to each process
    };

    enum class End
    {
      alone, // the others may wait for this process elsewhere
      some_failed,
      all_failed
    };

    // How all processes ended. One that failed waits for the others for five seconds only.
    End end_of_all(const MPI_Comm communicator, const bool has_failed)
    {
      constexpr std::chrono::seconds patience(5);
      const int                      mine = int(has_failed);
      int                            all = 0, arrived = 0;
      MPI_Request                    request = MPI_REQUEST_NULL;
      MPI_Iallreduce(&mine, &all, 1, MPI_INT, MPI_MIN, communicator, &request);
      const auto begin = std::chrono::steady_clock::now();
      while (arrived == 0)
        {
          if (has_failed && std::chrono::steady_clock::now() - begin > patience)
            return End::alone;
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
          MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
        }
      return all == 1 ? End::all_failed : End::some_failed;
    }
  } // namespace

  void avoid_mpi_daemon()
  {
    if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr && std::getenv("PMI_SIZE") == nullptr)
      {
        setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
        // Without a daemon all processes of a user share one folder of session files, and the first one to end removes it.
        setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
      }
  }

  bool is_first_process()
  {
    return rank_in(MPI_COMM_WORLD) == 0;
  }

  unsigned int n_processes()
  {
    return unsigned(size_of(MPI_COMM_WORLD));
  }

  void leave_for_mpi_abort(const int code)
  {
    if (n_processes() == 1)
      throw std::runtime_error(
        "a library of the continuum called MPI_Abort, often because memory is short; see its message above");
    PMPI_Abort(MPI_COMM_WORLD, code);
    std::abort();
  }

  int on_first_process(const std::function<int()> &work)
  {
    if (n_processes() == 1)
      return work();
    std::exception_ptr thrown;
    std::string        text;
    int                code_and_kind[2] = {0, int(Failure::none)};
    if (is_first_process())
      try
        {
          code_and_kind[0] = work();
        }
      catch (const std::exception &error)
        {
          thrown           = std::current_exception();
          text             = error.what();
          code_and_kind[1] = int(kind_of(error));
        }
    MPI_Bcast(code_and_kind, 2, MPI_INT, 0, MPI_COMM_WORLD);
    text = broadcast(std::move(text), MPI_CHAR);
    if (thrown)
      std::rethrow_exception(thrown);
    if (code_and_kind[1] != int(Failure::none))
      throw_as(Failure(code_and_kind[1]), text);
    return code_and_kind[0];
  }

  double sum_over_processes(const double value)
  {
    double sum = 0;
    MPI_Allreduce(&value, &sum, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return sum;
  }

  double from_first_process(double value)
  {
    MPI_Bcast(&value, 1, MPI_DOUBLE, 0, MPI_COMM_WORLD);
    return value;
  }

  std::vector<double> from_first_process(std::vector<double> values)
  {
    return broadcast(std::move(values), MPI_DOUBLE);
  }

  bool any_process(const bool value)
  {
    const int mine = int(value);
    int       any  = 0;
    MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    return any == 1;
  }

  discrete::Processes &mpi_processes()
  {
    static MpiProcesses processes;
    return processes;
  }

  int run_and_report(const std::function<int()> &work,
                     int (*code_of)(const std::exception &),
                     std::string (*text_of)(const std::exception &))
  {
    // A separate communicator: the barrier must not match one that `work` waits in.
    MPI_Comm communicator = MPI_COMM_NULL;
    MPI_Comm_dup(MPI_COMM_WORLD, &communicator);
    int code = 0;
    try
      {
        code = work();
        (void)end_of_all(communicator, false);
      }
    catch (const std::exception &error)
      {
        code          = code_of(error);
        const End end = end_of_all(communicator, true);
        if (is_first_process() || end != End::all_failed)
          std::cerr << text_of(error) << std::endl;
        if (end == End::alone)
          PMPI_Abort(MPI_COMM_WORLD, code);
      }
    MPI_Comm_free(&communicator);
    return code;
  }
} // namespace diptych::coupling
