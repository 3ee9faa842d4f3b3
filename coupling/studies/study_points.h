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
    std::optional<Scene> scene;   // none where the settings contradict each other
    std::string          refusal; // why
    std::string          name;    // of its folder: a digest of what is run; the same for the same scene and command
    StudyCommand         command = StudyCommand::run;
  };

  struct ScenePoint
  {
    int                      family    = -1; // -1: a reference
    std::size_t              reference = 0;  // the place of the one that it is held against; its own, where it is one
    std::vector<std::size_t> places;         // on the family's axes
    std::vector<std::string> labels;         // of these places
    std::vector<std::string> settings;       // "section/key = value" beyond those of all points
    std::vector<StudyRun>    runs;           // one a sample
  };

  // The references first: the study's, and it at every point of the axes that have their own. Then every family's points, the
  // last axis fastest. Throws SceneError where the reference itself is refused, or where there are more than 100000 runs.
  std::vector<ScenePoint> points_of(const Study &study);
} // namespace diptych::coupling
