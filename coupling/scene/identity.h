// diptych: what makes two scenes the same
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  // Typed values by section/key, files by what is in them: neither the wording of a help text nor the place of a file is part of
  // it, nor a key that changes no result (output, time between checkpoints).
  using Identity = std::map<std::string, std::string>;

  Identity sample_identity(const Scene &scene);    // which sample both panels show, and how the grains are loaded
  Identity continuum_identity(const Scene &scene); // that, and what the continuum shows of it
  Identity member_identity(const Scene &scene);    // all that members of an ensemble have in common: not seed and margins

  // Files that a run of the scene reads, by section/key; {seed} in a path is filled in.
  std::vector<std::pair<std::string, std::string>> input_files(const Scene &scene);

  // FNV-1a, 64 bits, of bytes.
  std::uint64_t digest_of(std::string_view bytes);

  // The same of bytes that come piece by piece, from empty_digest on.
  constexpr std::uint64_t empty_digest = 14695981039346656037ull;
  std::uint64_t           digest_on(std::uint64_t digest, std::string_view bytes);

  std::string hexadecimal(std::uint64_t digest); // 16 digits

  // One line a value, for files.
  std::string text_of(const Identity &identity);

  // "sample/seed = '2' here, '1' there": the first value that differs; empty where none does.
  std::string first_difference(const Identity &here, const Identity &there);
} // namespace diptych::coupling
