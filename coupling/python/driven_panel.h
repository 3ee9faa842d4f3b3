// diptych: a panel for Python, with signals and a callback between steps and the GIL released during steps
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <pybind11/pybind11.h>

#include "coupling/python/rows.h"

namespace diptych::python
{
  namespace py = pybind11;

  // Either panel with the rows of its history. Panel::prepare() and advance_to() run without the GIL. Before every step, and
  // within long steps, the panel calls to_stop(). This takes the GIL if there are new rows for the callback, and every 50 ms to
  // check signals. A Python exception there stops the run like a normal stop, so the panel stays valid and can continue. The
  // exception is rethrown after the panel has returned.
  template <class Panel, class Hooks, class Row> class DrivenPanel
  {
  public:
    using Make = std::function<Panel(Hooks)>;

    explicit DrivenPanel(const Make &make)
    {
      Hooks hooks;
      hooks.stop_requested = [this] { return to_stop(); };
      hooks.on_row         = [this](const Row &row) { rows_.push_back(row); };
      panel_               = std::make_unique<Panel>(make(hooks));
    }
    DrivenPanel(const DrivenPanel &)            = delete; // the hooks hold `this`
    DrivenPanel &operator=(const DrivenPanel &) = delete;
    ~DrivenPanel() { release(); }

    // "finished", "stopped" or "not_converged".
    std::string prepare(const py::object &on_step)
    {
      return run(on_step, [this] { return panel().prepare(); });
    }
    std::string advance(const int stage, const py::object &on_step)
    {
      return run(on_step, [this, stage] { return panel().advance_to(stage); });
    }

    // May be called between steps and from the callback. Throws std::runtime_error if another thread runs the panel.
    auto snapshot() const
    {
      demand_rest();
      return panel().snapshot();
    }

    void demand_rest() const
    {
      if (is_working_ && std::this_thread::get_id() != worker_)
        throw std::runtime_error("the panel is at work in another thread");
    }

    const Panel &panel() const { return const_cast<DrivenPanel *>(this)->panel(); }
    Panel       &panel()
    {
      if (!panel_)
        throw std::runtime_error("the panel is closed");
      return *panel_;
    }
    py::dict report() const // entries of the panel's report
    {
      py::dict dict;
      visit_facts(panel().report(), [&](const char *name, const auto &value, const char *, const char *) { dict[name] = value; });
      return dict;
    }
    const std::vector<Row> &rows() const
    {
      demand_rest();
      return rows_;
    }

    void release() { panel_.reset(); } // frees the memory; the panel cannot be used again

  private:
    using Clock  = std::chrono::steady_clock;
    using Status = decltype(std::declval<Panel &>().prepare());

    template <class Work> std::string run(const py::object &on_step, const Work &work)
    {
      if (is_working_.exchange(true))
        throw std::runtime_error("the panel is already at work: in another thread, or in the call that called this callback");
      worker_                   = std::this_thread::get_id();
      on_step_                  = on_step.is_none() ? py::object() : on_step;
      error_                    = nullptr;
      stops_                    = false;
      Status             status = Status::finished;
      std::exception_ptr failure;
      {
        const py::gil_scoped_release release;
        try
          {
            status = work();
          }
        catch (...)
          {
            failure = std::current_exception();
          }
      }
      if (!failure && !error_)
        pass_rows();
      passed_     = rows_.size();
      on_step_    = py::object();
      is_working_ = false;
      if (error_)
        std::rethrow_exception(std::exchange(error_, nullptr));
      if (failure)
        std::rethrow_exception(failure);
      if (stops_ || status == Status::stopped_by_user)
        return "stopped";
      return status == Status::finished ? "finished" : "not_converged";
    }

    bool to_stop()
    {
      if (stops_ || error_)
        return true;
      const bool has_rows = on_step_ && passed_ < rows_.size();
      if (!has_rows && Clock::now() - asked_ < std::chrono::milliseconds(50))
        return false;
      const py::gil_scoped_acquire gil;
      asked_ = Clock::now();
      if (PyErr_CheckSignals() != 0)
        error_ = std::make_exception_ptr(py::error_already_set());
      else
        pass_rows();
      return stops_ || error_;
    }

    // Needs the GIL. The run stops if the callback returns the object False.
    void pass_rows()
    {
      try
        {
          for (; on_step_ && passed_ < rows_.size() && !stops_; ++passed_)
            stops_ = on_step_(row_dict(rows_[passed_])).is(py::bool_(false));
        }
      catch (...)
        {
          error_ = std::current_exception();
        }
    }

    std::unique_ptr<Panel> panel_;
    std::vector<Row>       rows_;
    py::object             on_step_;
    std::size_t            passed_ = 0; // number of rows passed to the callback
    std::atomic<bool>      is_working_{false};
    bool                   stops_ = false;
    std::thread::id        worker_;
    std::exception_ptr     error_; // exception of Python between two steps
    Clock::time_point      asked_ = Clock::now();
  };
} // namespace diptych::python
