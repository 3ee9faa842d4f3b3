// diptych: a panel as Python drives it: signals and a callback between steps, the GIL released in the steps
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

  // Either panel, with the rows of its history. Panel::prepare() and advance_to() run without the GIL. Before every step and
  // within the long ones the panel asks to_stop(), which takes the GIL when there are rows for the callback, and every 50 ms for
  // signals: what Python throws there ends the run as a stop does, so that the panel stays whole and may go on, and is thrown
  // again when the panel has returned.
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
    DrivenPanel(const DrivenPanel &)            = delete; // the hooks call this one
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

    // Between steps, from the callback, too. Throws std::runtime_error where another thread drives the panel.
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
    const std::vector<Row> &rows() const
    {
      demand_rest();
      return rows_;
    }

    void release() { panel_.reset(); } // for good, with its memory

  private:
    using Clock  = std::chrono::steady_clock;
    using Status = decltype(std::declval<Panel &>().prepare());

    template <class Work> std::string run(const py::object &on_step, const Work &work)
    {
      if (is_working_.exchange(true))
        throw std::runtime_error("the panel is already at work: in another thread, or in the call that called this callback");
      worker_  = std::this_thread::get_id();
      on_step_ = on_step.is_none() ? py::object() : on_step;
      error_ = nullptr, stops_ = false;
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
        tell_rows();
      told_       = rows_.size();
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
      const bool has_rows = on_step_ && told_ < rows_.size();
      if (!has_rows && Clock::now() - asked_ < std::chrono::milliseconds(50))
        return false;
      const py::gil_scoped_acquire gil;
      asked_ = Clock::now();
      if (PyErr_CheckSignals() != 0)
        error_ = std::make_exception_ptr(py::error_already_set());
      else
        tell_rows();
      return stops_ || error_;
    }

    // With the GIL. A callback that returns False, that very object, ends the run.
    void tell_rows()
    {
      try
        {
          for (; on_step_ && told_ < rows_.size() && !stops_; ++told_)
            stops_ = on_step_(row_dict(rows_[told_])).is(py::bool_(false));
        }
      catch (...)
        {
          error_ = std::current_exception();
        }
    }

    std::unique_ptr<Panel> panel_;
    std::vector<Row>       rows_;
    py::object             on_step_;
    std::size_t            told_ = 0; // rows that the callback has seen
    std::atomic<bool>      is_working_{false};
    bool                   stops_ = false;
    std::thread::id        worker_;
    std::exception_ptr     error_; // thrown by Python between two steps
    Clock::time_point      asked_ = Clock::now();
  };
} // namespace diptych::python
