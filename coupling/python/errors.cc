// diptych: translation of scene errors to a Python exception
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/processes/stop_signal.h"
#include "coupling/python/bindings.h"
#include "coupling/scene/scene_error.h"

namespace diptych::python
{
  void translate_errors()
  {
    namespace py = pybind11;
    py::register_local_exception_translator([](std::exception_ptr thrown) {
      try
        {
          std::rethrow_exception(thrown);
        }
      catch (const coupling::SceneError &error)
        {
          const py::object type  = py::module_::import("diptych.errors").attr("SceneError");
          py::object       value = type(error.what());
          const auto      &r     = error.refusal;
          value.attr("file")     = r.place.file;
          value.attr("line")     = r.place.line;
          if (!r.key.empty())
            value.attr("key") = r.key;
          value.attr("value")   = r.value;
          value.attr("allowed") = r.allowed;
          value.attr("hint")    = r.hint;
          PyErr_SetObject(type.ptr(), value.ptr());
        }
      catch (const coupling::StoppedOnRequest &stopped)
        {
          PyErr_SetString(py::object(py::module_::import("diptych.errors").attr("Stopped")).ptr(), stopped.what());
        }
    });
  }
} // namespace diptych::python
