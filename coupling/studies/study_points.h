// diptych: the points of a study, each on every sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "coupling/scene/scene.h"
#include "coupling/studies/study.h"

namespace diptych::coupling
{
  // One point on one sample.
  struct StudyRun
  {
    std::optional<Scene> scene;   // none if the settings contradict each other
    std::string          refusal; // the message in that case
    std::string          name;    // of its folder; equal for equal scene and command
    StudyCommand         command = StudyCommand::run;
  };

  struct ScenePoint
  {
    int                      family    = -1; // -1: a reference
    std::size_t              reference = 0;  // index of its reference point; a reference has its own index
    std::vector<std::size_t> places;         // indices on the family's axes
    std::vector<std::string> labels;         // of these places
    std::vector<std::string> settings;       // "section/key = value" beyond those of all points
    std::vector<StudyRun>    runs;           // one per sample
  };

  // References come first: that of the study, then one for every point of the axes with their own references. The points of
  // every family follow, the last axis fastest. Throws SceneError if a reference is refused or if there are more than 100000
  // runs.
  std::vector<ScenePoint> points_of(const Study &study);
} // namespace diptych::coupling
