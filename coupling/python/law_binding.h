// diptych: Python binding of the constitutive laws at one point
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace diptych::python
{
  void bind_laws(pybind11::module_ &m);
} // namespace diptych::python
