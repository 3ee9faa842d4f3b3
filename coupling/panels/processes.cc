// diptych: helpers for several MPI processes that run the continuum together
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/panels/processes.h"

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include <mpi.h>

#include "coupling/processes/stop_signal.h"

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

    // True if every process arrives here within five seconds. Then all met an error, the same one or each its own.
    bool all_arrive(const MPI_Comm communicator)
    {
      constexpr std::chrono::seconds patience(5);
      MPI_Request                    request;
      MPI_Ibarrier(communicator, &request);
      const auto begin = std::chrono::steady_clock::now();
      for (int arrived = 0; std::chrono::steady_clock::now() - begin < patience;)
        {
          MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
          if (arrived != 0)
            return true;
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
      return false;
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
      }
    catch (const std::exception &error)
      {
        code              = code_of(error);
        const bool shared = all_arrive(communicator);
        if (is_first_process() || !shared)
          std::cerr << text_of(error) << std::endl;
        if (!shared)
          PMPI_Abort(MPI_COMM_WORLD, code);
      }
    MPI_Comm_free(&communicator);
    return code;
  }
} // namespace diptych::coupling
