// diptych: result files of a plan
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/plans/plan_output.h"

#include "coupling/numbers/number_json.h"
#include "coupling/plans/plan_numbers.h"
#include "coupling/scene/scene_file.h"
#include "discrete/files/text_file.h"

namespace diptych::coupling
{
  void write_plan(const std::string &directory, const PlanQuestion &question, const Plan &plan)
  {
    nlohmann::json root = nlohmann::json::object();
    NumbersToJson  writer{root, 1};
    list_numbers(plan, writer);
    discrete::write_text(directory + "/plan.json", root.dump(1) + "\n");
    Settings settings = question.changes;
    for (const PanelPlan &panel : plan.panels)
      settings.insert(settings.end(), panel.settings.begin(), panel.settings.end());
    Scene scene            = read_changed_scene(question.scene, settings, false);
    scene.output.directory = "";
    discrete::write_text(directory + "/planned.prm", resolved_text(scene));
  }
} // namespace diptych::coupling
