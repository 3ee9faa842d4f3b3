// diptych: tables of the benchmark, one function per table
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/averaging/averaging.h"

namespace diptych::benchmarks
{
  // `samples`: folder that keeps the sheared sample. If it is empty, each call makes it again.
  void cost(const std::string &samples);           // CPU seconds of every method at 4000 and 64000 grains
  void known_stress(const std::string &samples);   // error of every method against a known stress field
  void sheared_grains(const std::string &samples); // scatter of every method on a sheared sample
  void resolution(const std::string &samples);     // stress against the averaging length

  struct NamedMethod
  {
    const char                *name;
    coupling::AveragingOptions options;
  };
  inline const std::vector<NamedMethod> methods = [] {
    using coupling::AveragingMethod;
    using coupling::KernelShape;
    return std::vector<NamedMethod>{{"segments", {AveragingMethod::segments}},
                                    {"centroid", {AveragingMethod::centroid}},
                                    {"laguerre", {AveragingMethod::laguerre}},
                                    {"kernel gauss w = 0.75", {AveragingMethod::kernel, KernelShape::gauss, 0.75}},
                                    {"kernel gauss w = 1.5", {AveragingMethod::kernel, KernelShape::gauss, 1.5}},
                                    {"kernel lucy w = 1.5", {AveragingMethod::kernel, KernelShape::lucy, 1.5}},
                                    {"projection w = 1.5", {AveragingMethod::projection, KernelShape::gauss, 1.5}}};
  }();
} // namespace diptych::benchmarks
