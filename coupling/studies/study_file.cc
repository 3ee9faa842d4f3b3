// diptych: reads and checks study files
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/studies/study_file.h"

#include <algorithm>
#include <filesystem>

#include "coupling/scene/keys.h"
#include "coupling/scene/scene_file.h"
#include "coupling/studies/study_columns.h"
#include "coupling/studies/study_part.h"
#include "discrete/files/nearest_name.h"

namespace diptych::coupling
{
  namespace
  {
    AxisPoint point_of(const Part &axis, const std::string &key, const Part &value)
    {
      const std::string word = value_text(value.json());
      AxisPoint         point{word, {axis.setting("values", key, value.json())}};
      point.value = value.json().is_number() ? value.json().get<double>() : NAN;
      return point;
    }

    Axis axis_of(const Part &part)
    {
      part.allow({"name", "key", "values", "points", "converges", "own_reference"});
      Axis axis;
      axis.converges     = part.flag("converges");
      axis.own_reference = part.flag("own_reference");
      if (part.has("key") == part.has("points"))
        part.refuse("an axis needs either key and values, or points with label and set");
      if (part.has("key"))
        for (const Part &value : part.list("values"))
          axis.points.push_back(point_of(part, part.word("key"), value));
      for (const Part &one : part.list("points"))
        {
          one.allow({"label", "set"});
          one.at("label");
          axis.points.push_back({one.word("label"), one.settings("set")});
        }
      if (axis.points.empty())
        part.refuse("this axis has no points; give values or points");
      axis.name = part.word("name", part.word("key", "points").substr(part.word("key", "points").find('/') + 1));
      std::vector<std::string> labels;
      for (const AxisPoint &point : axis.points)
        {
          if (std::find(labels.begin(), labels.end(), point.label) != labels.end())
            part.refuse("axis '" + axis.name + "' has '" + point.label + "' twice");
          labels.push_back(point.label);
          if (axis.converges && !(point.value > 0))
            part.refuse("converges", " needs values above 0, which '" + point.label + "' is not");
        }
      return axis;
    }

    Family family_of(const Part &part)
    {
      Family family{part.word("name"), part.settings("set"), part.word("combine", "grid") == "grid", {}};
      if (const std::string word = part.word("combine", "grid"); word != "grid" && word != "list")
        part.refuse("combine", " = '" + word + "' is not allowed; use grid or list");
      for (const Part &axis : part.list("axes"))
        {
          family.axes.push_back(axis_of(axis));
          const Axis &last = family.axes.back();
          if (std::count_if(family.axes.begin(), family.axes.end(), [&](const Axis &other) { return other.name == last.name; }) >
              1)
            axis.refuse("two axes have the name '" + last.name + "'");
          if (!family.is_grid && last.points.size() != family.axes.front().points.size())
            axis.refuse("axes combined as a list need equally many points; '" + family.axes.front().name + "' has " +
                        std::to_string(family.axes.front().points.size()) + ", '" + last.name + "' " +
                        std::to_string(last.points.size()));
        }
      return family;
    }

    std::vector<Family> families_of(const Part &root)
    {
      std::vector<Family> families;
      if (root.has("families") && root.has("axes"))
        root.refuse("axes", " cannot be used together with families; put axes into each family");
      if (!root.has("families"))
        families.push_back(family_of(root)), families.back().settings.clear();
      for (const Part &part : root.list("families"))
        {
          part.allow({"name", "set", "axes", "combine"});
          part.at("name");
          families.push_back(family_of(part));
        }
      return families;
    }

    void read_reduction(const Part &part, StudyQuantity &quantity)
    {
      constexpr double far  = 1e12;
      const auto       pair = [&](const std::string &key) {
        const std::vector<Part> ends = part.list(key);
        if (ends.size() != 2 || !ends[0].json().is_number() || !ends[1].json().is_number() || !(ends[0].json() < ends[1].json()))
          part.refuse(key, " = " + part.json()[key].dump() + " is not allowed; give two ascending values of the progress");
        quantity.from = ends[0].json(), quantity.to = ends[1].json();
      };
      std::vector<Reduction> given;
      for (const auto &[reduction, name] : choices(Reduction()))
        if (part.has(name))
          given.push_back(reduction);
      if (given.size() != 1)
        part.refuse("a quantity needs exactly one of " + discrete::listed(names_of(Reduction())));
      quantity.reduction = given.front();
      switch (given.front())
        {
        case Reduction::strength:
          return pair("strength");
        case Reduction::mean:
          return pair("mean");
        case Reduction::at:
          quantity.from = part.number("at", 0, far);
          return;
        case Reduction::peak:
          quantity.to = part.number("peak", 1e-12, far);
          return;
        case Reduction::number:
          quantity.column = part.word("number");
          return;
        default:
          if (!part.flag(discrete::name_of(given.front())))
            part.refuse(discrete::name_of(given.front()), " must be true or left out");
        }
    }

    void read_limit(const Part &part, StudyQuantity &quantity)
    {
      if (!part.has("limit"))
        return;
      const Part limit = part.at("limit");
      limit.allow({"relative", "absolute"});
      if (limit.json().size() != 1)
        limit.refuse("a limit needs one of relative and absolute");
      quantity.is_relative = limit.has("relative");
      quantity.limit       = limit.number(quantity.is_relative ? "relative" : "absolute", 1e-12, 1e12);
    }

    // True if the command writes the file that the quantity is read from.
    bool makes(const StudyCommand command, const Source source)
    {
      switch (command)
        {
        case StudyCommand::discrete:
          return source == Source::discrete;
        case StudyCommand::continuum:
          return source == Source::continuum;
        case StudyCommand::material_point:
          return source == Source::material_point;
        default:
          return source != Source::material_point;
        }
    }

    StudyQuantity quantity_of(const Part &part, const StudyCommand command)
    {
      part.allow({"name", "of", "column", "strength", "mean", "at", "peak", "largest", "last", "number", "limit"});
      StudyQuantity quantity;
      quantity.source = part.has("number") ? Source::comparison
                                           : part.choice("of", command == StudyCommand::continuum        ? Source::continuum
                                                               : command == StudyCommand::material_point ? Source::material_point
                                                                                                         : Source::discrete);
      if (!makes(command, quantity.source))
        part.refuse("command " + discrete::name_of(command) + " does not write what '" + discrete::name_of(quantity.source) +
                    "' is read from; change command or of");
      quantity.column = part.word("column");
      read_reduction(part, quantity);
      read_limit(part, quantity);
      if (quantity.reduction == Reduction::strength || quantity.reduction == Reduction::number)
        {
          if (part.has("column"))
            part.refuse("column", " has no effect here; remove it");
        }
      else if (const auto names = column_names(quantity.source);
               std::find(names.begin(), names.end(), quantity.column) == names.end())
        part.refuse(part.has("column") ? "column" : "name",
                    " = '" + quantity.column + "': " + discrete::name_of(quantity.source) +
                      ".csv has no such column; the nearest is '" + discrete::nearest_name(quantity.column, names) + "'");
      try
        {
          describe(quantity);
        }
      catch (const std::invalid_argument &error)
        {
          part.refuse("number", std::string(" = ") + error.what());
        }
      quantity.name = part.word("name", default_name(quantity));
      return quantity;
    }

    Border border_of(const Part &part, const std::vector<Family> &families)
    {
      part.allow({"label", "family", "x", "y", "coefficient", "exponent"});
      Border border{part.word("label"), part.word("family"), part.word("x"), part.word("y")};
      border.coefficient = part.number("coefficient", -1e300, 1e300);
      border.exponent    = part.number("exponent", -100, 100);
      const auto family  = std::find_if(families.begin(), families.end(),
                                        [&](const Family &f) { return f.name == border.family; });
      if (family == families.end())
        part.refuse("family", " = '" + border.family + "': there is no such family");
      for (const std::string &name : {border.x, border.y})
        if (std::none_of(family->axes.begin(), family->axes.end(), [&](const Axis &axis) { return axis.name == name; }))
          part.refuse("'" + name + "' is not an axis of this family");
      return border;
    }

    // A wrong name would count as a cost of zero.
    std::string phase_of(const Part &part)
    {
      const std::vector<std::string> phases = {"preparation", "discrete", "continuum",     "continuum_coarse",
                                               "comparison",  "report",   "material_point"};
      const std::string              name   = value_text(part.json());
      if (std::find(phases.begin(), phases.end(), name) == phases.end())
        part.refuse("cost: '" + name + "' is not a phase; the nearest is '" + discrete::nearest_name(name, phases) + "'");
      return name;
    }

    void demand_distinct_names(const Part &root, const Study &study)
    {
      std::vector<std::string> names;
      for (const StudyQuantity &quantity : study.quantities)
        names.push_back(quantity.name);
      std::sort(names.begin(), names.end());
      if (const auto twice = std::adjacent_find(names.begin(), names.end()); twice != names.end())
        root.refuse("quantities", ": two have the name '" + *twice + "'; give them different names");
      names.clear();
      for (const Family &family : study.families)
        names.push_back(family.name);
      std::sort(names.begin(), names.end());
      if (const auto twice = std::adjacent_find(names.begin(), names.end()); twice != names.end())
        root.refuse("families", ": two have the name '" + *twice + "'");
    }

    // A fixed seed would be replaced, because every point is run with every seed.
    void demand_one_source_of_seeds(const Part &root, const Study &study)
    {
      const auto demand = [&](const Settings &settings) {
        for (const Entry &entry : settings)
          if (entry.section == "sample" && entry.key == "seed" && !study.seeds.empty())
            root.refuse("seeds",
                        " cannot be used together with sample/seed = " + entry.value + ", set at " + text_of(entry.place));
      };
      demand(study.settings), demand(study.reference);
      for (const Family &family : study.families)
        {
          demand(family.settings);
          for (const Axis &axis : family.axes)
            for (const AxisPoint &point : axis.points)
              demand(point.settings);
        }
    }

    std::string study_name(const std::string &file)
    {
      const std::filesystem::path path = std::filesystem::absolute(file);
      return path.stem() == "study" ? path.parent_path().filename().string() : path.stem().string();
    }
  } // namespace

  Study read_study(const std::string &file, const std::vector<std::string> &overrides)
  {
    std::istringstream in   = scene_input(file);
    const JsonText     text = read_json_text(file, in);
    const Part         root(text, text.root, "");
    root.allow(
      {"title", "scene", "command", "set", "seeds", "reference", "families", "axes", "combine", "quantities", "cost", "borders"});
    Study study;
    study.name    = study_name(file);
    study.file    = file;
    study.title   = root.word("title", study.name);
    study.scene   = resolved(root.word("scene"), std::filesystem::path(file).parent_path().string());
    study.command = root.choice("command", StudyCommand::run);
    if (!std::filesystem::is_regular_file(study.scene))
      root.refuse("scene", " = '" + study.scene + "': there is no such file");
    study.settings = root.settings("set");
    for (const std::string &text_of_override : overrides)
      {
        study.settings.push_back(entry_of_override(text_of_override));
        check_entry(with_seed(study.settings.back(), "1"));
        refuse_folder(study.settings.back());
      }
    study.seeds = root.seeds("seeds");
    root.at("reference");
    study.reference = root.settings("reference");
    study.families  = families_of(root);
    for (const Part &part : root.list("quantities"))
      study.quantities.push_back(quantity_of(part, study.command));
    if (study.quantities.empty())
      root.refuse("quantities", " is missing or empty; name at least one quantity");
    for (const Part &phase : root.list("cost"))
      study.cost.push_back(phase_of(phase));
    for (const Part &part : root.list("borders"))
      study.borders.push_back(border_of(part, study.families));
    demand_distinct_names(root, study);
    demand_one_source_of_seeds(root, study);
    return study;
  }
} // namespace diptych::coupling
