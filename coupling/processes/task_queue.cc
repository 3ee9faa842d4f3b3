// diptych: distributes many runs of the program over workers
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/processes/task_queue.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <thread>

#include <mpi.h>
#include <unistd.h>

#include "coupling/processes/processes.h"
#include "coupling/processes/progress.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/processes/worker.h"

namespace diptych::coupling
{
  namespace
  {
    using Clock = std::chrono::steady_clock;

    constexpr std::chrono::milliseconds pause(20);
    constexpr int                       ask_tag = 1, answer_tag = 2, outcome_tag = 3, no_task = -1;

    struct Ended
    {
      TaskOutcome outcome;
      double      seconds = 0;
    };

    // One line on a terminal; in a log one for every twentieth of the tasks.
    class TaskProgress
    {
    public:
      TaskProgress(const TaskQueue &queue, const int n_at_once)
          : quiet(queue.quiet),
            terminal(isatty(STDERR_FILENO) != 0),
            noun(queue.noun),
            n_total(int(queue.tasks.size()) + queue.n_finished_before),
            n_at_once(n_at_once),
            n_done(queue.n_finished_before)
      {}

      void ended(const Ended &one)
      {
        ++(one.outcome.exit_code == 0 ? n_done : n_failed);
        known_seconds += one.seconds;
        ++n_known;
      }

      // running_seconds: sum over the running tasks of their times so far.
      void show(const int n_running, const double running_seconds, const bool changed)
      {
        const int    n_ended = n_done + n_failed, part = 20 * n_ended / std::max(1, n_total);
        const double at_once = std::max(1, std::min(n_at_once, n_total - n_ended));
        const double left    = (known_seconds / std::max(1, n_known) * (n_total - n_ended) - running_seconds) / at_once;
        const double waited  = std::chrono::duration<double>(Clock::now() - shown).count();
        if (quiet || (terminal ? waited < 0.2 && !changed : part == last_part))
          return;
        const std::string remaining = n_known > 0 ? ", " + duration_text(left) + " remaining" : "";
        std::fprintf(stderr, "%s%d of %d %s done, %d running, %d failed%s%s", terminal ? "\r\033[K" : "", n_done, n_total,
                     noun.c_str(), n_running, n_failed, remaining.c_str(), terminal ? "" : "\n");
        shown     = Clock::now();
        last_part = part;
      }

      // Clears the line before a message.
      void clear_line() const
      {
        if (!quiet && terminal)
          std::fprintf(stderr, "\r\033[K");
      }

    private:
      bool              quiet, terminal;
      std::string       noun;
      int               n_total, n_at_once, n_done, n_failed = 0, n_known = 0, last_part = -1;
      double            known_seconds = 0;
      Clock::time_point shown         = Clock::now() - std::chrono::hours(1);
    };

    // The workers of this process and their tasks.
    class Crew
    {
    public:
      explicit Crew(const TaskQueue &queue)
          : queue(queue),
            at_work(std::size_t(queue.jobs))
      {
        for (int k = 0; k < queue.jobs; ++k)
          workers.emplace_back(queue.worker);
      }

      int n_free() const
      {
        return int(std::count_if(workers.begin(), workers.end(), [](const Worker &worker) { return worker.is_free(); }));
      }

      void begin(const std::size_t task)
      {
        const auto free = std::find_if(workers.begin(), workers.end(), [](const Worker &worker) { return worker.is_free(); });
        free->begin({queue.tasks[task].words, queue.tasks[task].log});
        at_work[std::size_t(free - workers.begin())] = task;
      }

      std::vector<Ended> ended()
      {
        if (stop_requested() && !asked)
          {
            asked = true;
            for (const Worker &worker : workers)
              worker.ask_to_stop();
          }
        std::vector<Ended> result;
        for (std::size_t k = 0; k < workers.size(); ++k)
          if (const auto code = workers[k].ended())
            result.push_back({{at_work[k], *code, asked && *code != 0}, workers[k].seconds()});
        return result;
      }

      double running_seconds() const
      {
        double sum = 0;
        for (const Worker &worker : workers)
          sum += worker.is_free() ? 0 : worker.seconds();
        return sum;
      }

    private:
      const TaskQueue         &queue;
      std::vector<Worker>      workers;
      std::vector<std::size_t> at_work; // task of each worker
      bool                     asked = false;
    };

    bool has_arrived(const int tag, MPI_Status &status)
    {
      int arrived = 0;
      if (n_processes() > 1)
        MPI_Iprobe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &arrived, &status);
      return arrived != 0;
    }

    std::vector<Ended> outcomes_of_others()
    {
      std::vector<Ended> received;
      for (MPI_Status status; has_arrived(outcome_tag, status);)
        {
          double numbers[4];
          MPI_Recv(numbers, 4, MPI_DOUBLE, status.MPI_SOURCE, outcome_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
          received.push_back({{std::size_t(numbers[0]), int(numbers[1]), numbers[2] != 0}, numbers[3]});
        }
      return received;
    }

    void report_failure(const TaskQueue &queue, const TaskOutcome &outcome, const TaskProgress &progress)
    {
      if (outcome.exit_code == 0 || outcome.interrupted)
        return;
      progress.clear_line();
      const Task       &task  = queue.tasks[outcome.task];
      const std::string words = last_words(task.log);
      std::cerr << task.name << " failed with exit code " << outcome.exit_code << ": "
                << (!words.empty()            ? words
                    : outcome.exit_code > 128 ? "ended by a signal, without a message"
                                              : "without a message")
                << " (log: " << task.log << ')' << std::endl;
    }

    // Hands out the tasks. Serves its own workers like those of other processes.
    class Lead
    {
    public:
      explicit Lead(const TaskQueue &queue)
          : queue(queue),
            crew(queue),
            n_at_once(queue.jobs * int(n_processes())),
            progress(queue, n_at_once)
      {}

      std::vector<TaskOutcome> run()
      {
        const int others = queue.jobs * int(n_processes() - 1); // each of the others' workers gets one dismissal
        while (outcomes.size() < queue.tasks.size() || n_dismissed < others)
          {
            const bool changed = take_outcomes();
            drop_tasks_on_stop();
            while (crew.n_free() > 0 && next < queue.tasks.size())
              crew.begin(next++);
            answer_others();
            const int n_left = int(queue.tasks.size() - outcomes.size());
            progress.show(n_processes() > 1 ? std::min(n_at_once, n_left) : queue.jobs - crew.n_free(),
                          n_processes() * crew.running_seconds(), changed);
            std::this_thread::sleep_for(pause);
          }
        progress.clear_line();
        std::sort(outcomes.begin(), outcomes.end(), [](const auto &a, const auto &b) { return a.task < b.task; });
        return outcomes;
      }

    private:
      bool take_outcomes()
      {
        std::vector<Ended> ended = crew.ended();
        for (const Ended &other : outcomes_of_others())
          ended.push_back(other);
        for (Ended &one : ended)
          {
            note_end(one.outcome);
            outcomes.push_back(one.outcome);
            if (!one.outcome.interrupted)
              progress.ended(one);
            report_failure(queue, one.outcome, progress);
          }
        return !ended.empty();
      }

      // A full disk must not end the other tasks.
      void note_end(TaskOutcome &outcome)
      {
        try
          {
            queue.on_ended(outcome);
          }
        catch (const std::exception &error)
          {
            progress.clear_line();
            std::cerr << queue.tasks[outcome.task].name << ": " << error.what() << std::endl;
            outcome.exit_code = system_ended_task;
          }
      }

      void drop_tasks_on_stop()
      {
        for (; stop_requested() && next < queue.tasks.size(); ++next)
          outcomes.push_back({next, 0, true});
      }

      void answer_others()
      {
        for (MPI_Status status; has_arrived(ask_tag, status);)
          {
            int stops = 0;
            MPI_Recv(&stops, 1, MPI_INT, status.MPI_SOURCE, ask_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
            const int task = stops == 0 && next < queue.tasks.size() ? int(next++) : no_task;
            n_dismissed += task == no_task;
            MPI_Send(&task, 1, MPI_INT, status.MPI_SOURCE, answer_tag, MPI_COMM_WORLD);
          }
      }

      const TaskQueue         &queue;
      Crew                     crew;
      int                      n_at_once;
      TaskProgress             progress;
      std::vector<TaskOutcome> outcomes;
      std::size_t              next        = 0;
      int                      n_dismissed = 0;
    };

    // Asks the first process for a task whenever a worker is free.
    void follow(const TaskQueue &queue)
    {
      Crew crew(queue);
      int  n_asked = 0, n_dismissed = 0;
      while (n_dismissed < queue.jobs)
        {
          for (const auto &[outcome, seconds] : crew.ended())
            {
              const double numbers[4] = {double(outcome.task), double(outcome.exit_code), double(outcome.interrupted), seconds};
              MPI_Send(numbers, 4, MPI_DOUBLE, 0, outcome_tag, MPI_COMM_WORLD);
            }
          for (; n_asked + n_dismissed < crew.n_free(); ++n_asked)
            {
              const int stops = int(stop_requested());
              MPI_Send(&stops, 1, MPI_INT, 0, ask_tag, MPI_COMM_WORLD);
            }
          for (MPI_Status status; has_arrived(answer_tag, status); --n_asked)
            {
              int task = no_task;
              MPI_Recv(&task, 1, MPI_INT, 0, answer_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
              if (task == no_task)
                ++n_dismissed;
              else
                crew.begin(std::size_t(task));
            }
          std::this_thread::sleep_for(pause);
        }
    }

    // A blocking collective call would keep a core busy while other processes still run tasks.
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

  std::vector<TaskOutcome> run_tasks(const TaskQueue &queue)
  {
    std::vector<TaskOutcome> outcomes;
    if (is_first_process())
      outcomes = Lead(queue).run();
    else
      follow(queue);
    wait_for_all();
    return outcomes;
  }
} // namespace diptych::coupling
