// diptych: the members of an ensemble, run side by side
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/ensembles/ensemble_members.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <thread>

#include <mpi.h>
#include <unistd.h>

#include "coupling/processes/child_process.h"
#include "coupling/ensembles/ensemble_folder.h"
#include "coupling/processes/processes.h"
#include "coupling/processes/progress.h"
#include "coupling/processes/stop_signal.h"

namespace diptych::coupling
{
  namespace
  {
    using Clock = std::chrono::steady_clock;

    constexpr std::chrono::milliseconds pause(20);
    constexpr int                       outcome_tag = 1;

    struct RunningMember
    {
      int               seed    = 0;
      pid_t             program = 0;
      Clock::time_point begin   = Clock::now();
    };

    double seconds_since(const Clock::time_point begin)
    {
      return std::chrono::duration<double>(Clock::now() - begin).count();
    }

    // One line on a terminal; in a log one for every twentieth of the members.
    class MemberProgress
    {
    public:
      MemberProgress(const MemberRuns &runs, const int n_at_once)
          : quiet(runs.quiet),
            terminal(isatty(STDERR_FILENO) != 0),
            n_total(int(runs.seeds.size()) + runs.n_finished_before),
            n_at_once(n_at_once),
            n_done(runs.n_finished_before)
      {}

      void ended(const MemberOutcome &outcome, const double seconds)
      {
        ++(outcome.exit_code == 0 ? n_done : n_failed);
        known_seconds += seconds, ++n_known;
      }

      // running_seconds: how long each member that runs has been running, all together.
      void show(const int n_running, const double running_seconds, const bool changed)
      {
        const int    n_ended = n_done + n_failed, part = 20 * n_ended / std::max(1, n_total);
        const double at_once = std::max(1, std::min(n_at_once, n_total - n_ended));
        const double left    = (known_seconds / std::max(1, n_known) * (n_total - n_ended) - running_seconds) / at_once;
        if (quiet || (terminal ? seconds_since(shown) < 0.2 && !changed : part == last_part))
          return;
        std::fprintf(stderr, "%s%d of %d seeds done, %d running, %d failed, %s left%s", terminal ? "\r\033[K" : "", n_done,
                     n_total, n_running, n_failed, n_known > 0 ? duration_text(left).c_str() : "?", terminal ? "" : "\n");
        shown = Clock::now(), last_part = part;
      }

      // Room for a message.
      void clear_line() const
      {
        if (!quiet && terminal)
          std::fprintf(stderr, "\r\033[K");
      }

    private:
      bool              quiet, terminal;
      int               n_total, n_at_once, n_done, n_failed = 0, n_known = 0, last_part = -1;
      double            known_seconds = 0;
      Clock::time_point shown         = Clock::now() - std::chrono::hours(1);
    };

    RunningMember begin_member(const MemberRuns &runs, const int seed)
    {
      std::vector<std::string> words = runs.command;
      for (const std::string &word : {std::string("--set"), "sample/seed=" + std::to_string(seed), std::string("--output"),
                                      member_folder(runs.directory, seed)})
        words.push_back(word);
      return {seed, start_program(words, member_log(runs.directory, seed))};
    }

    // The seeds of this process, and what became of them.
    struct Share
    {
      const MemberRuns          &runs;
      std::vector<int>           waiting = {}; // last one first
      std::vector<RunningMember> running = {};
      bool                       asked   = false;

      std::vector<std::pair<MemberOutcome, double>> advance()
      {
        std::vector<std::pair<MemberOutcome, double>> ended;
        if (stop_requested() && !asked)
          {
            asked = true;
            for (const RunningMember &member : running)
              ask_to_stop(member.program);
            for (; !waiting.empty(); waiting.pop_back())
              ended.push_back({{waiting.back(), 0, true}, 0});
          }
        for (std::size_t k = 0; k < running.size();)
          if (const auto code = exit_code_of(running[k].program))
            {
              ended.push_back({{running[k].seed, *code, asked && *code != 0}, seconds_since(running[k].begin)});
              running.erase(running.begin() + std::ptrdiff_t(k));
            }
          else
            ++k;
        for (; int(running.size()) < runs.jobs && !waiting.empty(); waiting.pop_back())
          running.push_back(begin_member(runs, waiting.back()));
        return ended;
      }
    };

    Share own_share(const MemberRuns &runs)
    {
      Share              share{runs};
      const unsigned int n = n_processes(), own = own_number();
      for (std::size_t k = 0; k < runs.seeds.size(); ++k)
        if (k % n == own)
          share.waiting.push_back(runs.seeds[k]);
      std::reverse(share.waiting.begin(), share.waiting.end());
      return share;
    }

    void send_outcome(const MemberOutcome &outcome, const double seconds)
    {
      const double numbers[4] = {double(outcome.seed), double(outcome.exit_code), double(outcome.interrupted), seconds};
      MPI_Send(numbers, 4, MPI_DOUBLE, 0, outcome_tag, MPI_COMM_WORLD);
    }

    std::vector<std::pair<MemberOutcome, double>> received_outcomes()
    {
      std::vector<std::pair<MemberOutcome, double>> received;
      for (int arrived = 1; n_processes() > 1;)
        {
          double numbers[4];
          MPI_Iprobe(MPI_ANY_SOURCE, outcome_tag, MPI_COMM_WORLD, &arrived, MPI_STATUS_IGNORE);
          if (arrived == 0)
            break;
          MPI_Recv(numbers, 4, MPI_DOUBLE, MPI_ANY_SOURCE, outcome_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
          received.push_back({{int(numbers[0]), int(numbers[1]), numbers[2] != 0}, numbers[3]});
        }
      return received;
    }

    void tell(const MemberRuns &runs, const MemberOutcome &outcome, const MemberProgress &progress)
    {
      if (outcome.exit_code == 0 || outcome.interrupted)
        return;
      progress.clear_line();
      const std::string log = member_log(runs.directory, outcome.seed);
      std::cerr << "seed " << outcome.seed << " failed with exit code " << outcome.exit_code << ": " << last_words(log)
                << " (its output: " << log << ')' << std::endl;
    }

    // Of all processes, until every seed has ended.
    std::vector<MemberOutcome> lead(Share &share)
    {
      const MemberRuns          &runs = share.runs;
      std::vector<MemberOutcome> outcomes;
      const int                  n_at_once = runs.jobs * int(n_processes());
      MemberProgress             progress(runs, n_at_once);
      while (outcomes.size() < runs.seeds.size())
        {
          auto ended = share.advance();
          for (const auto &other : received_outcomes())
            ended.push_back(other);
          for (const auto &[outcome, seconds] : ended)
            {
              outcomes.push_back(outcome);
              if (!outcome.interrupted)
                progress.ended(outcome, seconds);
              tell(runs, outcome, progress);
            }
          double running_seconds = 0;
          for (const RunningMember &member : share.running)
            running_seconds += n_processes() * seconds_since(member.begin);
          const int n_left = int(runs.seeds.size() - outcomes.size());
          progress.show(n_processes() > 1 ? std::min(n_at_once, n_left) : int(share.running.size()), running_seconds,
                        !ended.empty());
          std::this_thread::sleep_for(pause);
        }
      progress.clear_line();
      std::sort(outcomes.begin(), outcomes.end(), [](const MemberOutcome &a, const MemberOutcome &b) { return a.seed < b.seed; });
      return outcomes;
    }

    void follow(Share &share)
    {
      while (!share.waiting.empty() || !share.running.empty())
        {
          for (const auto &[outcome, seconds] : share.advance())
            send_outcome(outcome, seconds);
          std::this_thread::sleep_for(pause);
        }
    }

    // A collective call would keep a core busy while other processes still have members to run.
    void wait_for_all()
    {
      MPI_Request request;
      MPI_Ibarrier(MPI_COMM_WORLD, &request);
      for (int arrived = 0; arrived == 0;)
        {
          MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
          std::this_thread::sleep_for(pause);
        }
    }
  } // namespace

  std::vector<MemberOutcome> run_members(const MemberRuns &runs)
  {
    Share                      share = own_share(runs);
    std::vector<MemberOutcome> outcomes;
    if (is_first_process())
      outcomes = lead(share);
    else
      follow(share);
    wait_for_all();
    return outcomes;
  }
} // namespace diptych::coupling
