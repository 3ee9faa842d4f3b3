// diptych: identity of a scene: all data that decide its results
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
  // Everything that decides a result, by section/key: the value of each key, and the content (not the path) of each file. Keys
  // that change no result (output, time between checkpoints) are left out.
  using Identity = std::map<std::string, std::string>;

  Identity sample_identity(const Scene &scene);    // sample and loading of the grains
  Identity continuum_identity(const Scene &scene); // sample_identity and all keys of the continuum
  Identity member_identity(const Scene &scene);    // all keys except seed and margins, as members of an ensemble have in common

  // Files that a run of the scene reads, as pairs of section/key and path. {seed} in a path is replaced by the seed.
  std::vector<std::pair<std::string, std::string>> input_files(const Scene &scene);

  // FNV-1a hash of bytes, 64 bits.
  std::uint64_t digest_of(std::string_view bytes);

  // Continues the hash of bytes that come in pieces. Begin with empty_digest.
  constexpr std::uint64_t empty_digest = 14695981039346656037ull;
  std::uint64_t           digest_on(std::uint64_t digest, std::string_view bytes);

  std::string hexadecimal(std::uint64_t digest); // 16 digits

  // One line per value, for files.
  std::string text_of(const Identity &identity);

  // "sample/seed = '2' here, '1' there": the first value that differs; empty if none differs.
  std::string first_difference(const Identity &here, const Identity &there);
} // namespace diptych::coupling
