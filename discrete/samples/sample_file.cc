// diptych: grains and time tables from files, checked before the computation
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/samples/sample_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "discrete/contacts/search_grid.h"
#include "discrete/contacts/contact_detection.h"
#include "discrete/files/csv_file.h"
#include "discrete/files/hdf5_file.h"
#include "discrete/files/staged_file.h"
#include "discrete/files/text_file.h"

namespace diptych::discrete
{
  namespace
  {
    // No sensible unit system exceeds these limits. They keep squares and cell numbers within double and int.
    constexpr double smallest_length = 1e-12, largest_magnitude = 1e12;

    // Platens and side walls: bodies n_grains to n_grains + 3.
    constexpr int most_walls = 4;

    constexpr const char *how_held = "0 (free), 1 (held), 2 or 3 (part of the lower or upper platen)";

    bool says_how_held(const double value)
    {
      return value == 0 || value == held_grain || value == lower_platen_grain || value == upper_platen_grain;
    }

    void check_magnitude(const CsvTable &csv, const std::size_t row, const std::string &column)
    {
      if (std::abs(csv.at(row, column)) > largest_magnitude)
        refuse_cell(csv, row, column, "-1e12 to 1e12");
    }

    double cell_or_zero(const CsvTable &csv, const std::size_t row, const std::string &column)
    {
      if (!csv.find(column))
        return 0;
      check_magnitude(csv, row, column);
      return csv.at(row, column);
    }

    void add_grain_of_row(const CsvTable &csv, const std::size_t row, const double density, Grains &grains)
    {
      for (const char *column : {"x", "y"})
        check_magnitude(csv, row, column);
      const double r = csv.at(row, "r");
      if (!(r >= smallest_length && r <= largest_magnitude))
        refuse_cell(csv, row, "r", "more than 0: 1e-12 to 1e12");
      const double fixed = cell_or_zero(csv, row, "fixed");
      if (!says_how_held(fixed))
        refuse_cell(csv, row, "fixed", how_held);
      add_grain(grains, {csv.at(row, "x"), csv.at(row, "y")}, r, density);
      grains.velocity.back() = {cell_or_zero(csv, row, "vx"), cell_or_zero(csv, row, "vy")};
      grains.spin.back()     = cell_or_zero(csv, row, "omega");
      grains.fixed.back()    = std::uint8_t(fixed);
    }

    int chosen_stage(const Hdf5Reader &file, const std::string &path, const int wanted)
    {
      const int n_stages = int(count_stages(file));
      if (wanted < -1 || wanted >= n_stages)
        throw std::invalid_argument(path + ": holds no stage " + std::to_string(wanted) + "; allowed: 0 to " +
                                    std::to_string(n_stages - 1) + ", or -1 for the last");
      return wanted == -1 ? n_stages - 1 : wanted;
    }

    struct StageReader
    {
      // Position of a wall; NaN if there is none or the file does not contain it.
      double place(const std::string &name) const
      {
        const double value = file.has_attribute(group, name) ? file.attribute(group, name) : NAN;
        return std::abs(value) <= largest_magnitude ? value : NAN;
      }

      const Hdf5Reader &file;
      std::string       path, group;

      [[noreturn]] void refuse(const std::string &dataset, const std::string &what) const
      {
        throw std::invalid_argument(path + ", dataset '" + group + "/" + dataset + "': " + what);
      }

      void check_size(const std::string &dataset, const std::size_t size, const std::size_t wanted) const
      {
        if (size != wanted)
          refuse(dataset, std::to_string(size) + " entries; allowed: " + std::to_string(wanted));
      }

      void check_value(const std::string &dataset, const std::size_t row, const double value, const double low) const
      {
        if (!(value >= low && value <= largest_magnitude))
          refuse(dataset, "entry " + std::to_string(row) + " (counted from 0) = " + exact_text(value) +
                            " is out of range; allowed: " + exact_text(low) + " to 1e12");
      }

      std::vector<double> numbers(const std::string &dataset, const std::size_t n, const double low) const
      {
        const std::vector<double> values = file.read(group + "/" + dataset);
        check_size(dataset, values.size(), n);
        for (std::size_t k = 0; k < n; ++k)
          check_value(dataset, k, values[k], low);
        return values;
      }

      std::vector<Eigen::Vector2d> vectors(const std::string &dataset, const std::size_t n) const
      {
        const std::vector<Eigen::Vector2d> values = file.read_vectors(group + "/" + dataset);
        check_size(dataset, values.size(), n);
        for (std::size_t k = 0; k < n; ++k)
          for (const double value : values[k])
            check_value(dataset, k, value, -largest_magnitude);
        return values;
      }

      double attribute(const std::string &name, const double low) const
      {
        const double value = file.attribute(group, name);
        if (!(value >= low && value <= largest_magnitude))
          throw std::invalid_argument(path + ", attribute '" + name + "' of '" + group + "' = " + exact_text(value) +
                                      " is out of range; allowed: " + exact_text(low) + " to 1e12");
        return value;
      }
    };

    std::vector<std::uint8_t> read_fixed(const StageReader &stage, const std::size_t n)
    {
      std::vector<std::uint8_t> fixed(n, 0);
      if (!stage.file.has(stage.group + "/grains/fixed"))
        return fixed;
      const std::vector<double> values = stage.numbers("grains/fixed", n, 0.);
      for (std::size_t k = 0; k < n; ++k)
        {
          if (!says_how_held(values[k]))
            stage.refuse("grains/fixed", "entry " + std::to_string(k) + " = " + exact_text(values[k]) + "; allowed: " + how_held);
          fixed[k] = std::uint8_t(values[k]);
        }
      return fixed;
    }

    Grains read_grains(const StageReader &stage, const bool of_another_code)
    {
      const auto is_told = [&](const char *dataset) { return !of_another_code || stage.file.has(stage.group + "/" + dataset); };

      const std::size_t n = stage.file.read(stage.group + "/grains/radius").size();
      if (n == 0)
        stage.refuse("grains/radius", "contains no grain; allowed: 1 or more");
      Grains grains;
      grains.radius   = stage.numbers("grains/radius", n, smallest_length);
      grains.position = stage.vectors("grains/position", n);
      grains.velocity.assign(n, Eigen::Vector2d::Zero());
      grains.rotation = grains.spin = std::vector<double>(n, 0.);
      if (is_told("grains/velocity"))
        grains.velocity = stage.vectors("grains/velocity", n);
      if (is_told("grains/rotation"))
        grains.rotation = stage.numbers("grains/rotation", n, -largest_magnitude);
      if (is_told("grains/spin"))
        grains.spin = stage.numbers("grains/spin", n, -largest_magnitude);
      grains.mass  = stage.numbers("grains/mass", n, 0.);
      grains.fixed = read_fixed(stage, n);
      for (std::size_t k = 0; k < n; ++k)
        if (grains.mass[k] == 0)
          stage.refuse("grains/mass", "entry " + std::to_string(k) + " (counted from 0) = 0; allowed: more than 0");
      return grains;
    }

    void check_pair(const StageReader &stage, const std::size_t row, const double i, const double j, const std::size_t n_grains)
    {
      const bool whole = i == std::floor(i) && j == std::floor(j);
      if (!(whole && i >= 0 && i < double(n_grains) && j > i && j < double(n_grains + most_walls)))
        stage.refuse("contacts/body", "row " + std::to_string(row) + " (counted from 0) = " + exact_text(i) + ", " +
                                        exact_text(j) + "; allowed: 0 to " + std::to_string(n_grains - 1) +
                                        ", and a larger number up to " + std::to_string(n_grains + most_walls - 1));
    }

    // Open contacts carry no impulse and are left out, as in State.
    std::vector<PairImpulse> read_impulses(const StageReader &stage, const std::size_t n_grains)
    {
      const std::string contacts = stage.group + "/contacts";
      if (is_written_by_us(stage.file) && !stage.file.has(contacts + "/body"))
        stage.refuse("contacts/body", "is missing");
      if (!stage.file.has(contacts) || (!stage.file.has(contacts + "/body") && !stage.file.has(contacts + "/impulse")))
        return {};
      const std::vector<double>          body    = stage.file.read(contacts + "/body");
      const std::vector<Eigen::Vector2d> impulse = stage.vectors("contacts/impulse", body.size() / 2);
      stage.check_size("contacts/body", body.size(), 2 * impulse.size());
      std::vector<PairImpulse> impulses;
      for (std::size_t k = 0; k < impulse.size(); ++k)
        {
          check_pair(stage, k, body[2 * k], body[2 * k + 1], n_grains);
          if (impulse[k].x() != 0)
            impulses.push_back({int(body[2 * k]), int(body[2 * k + 1]), impulse[k].x(), impulse[k].y()});
        }
      std::sort(impulses.begin(), impulses.end(),
                [](const PairImpulse &a, const PairImpulse &b) { return a.i != b.i ? a.i < b.i : a.j < b.j; });
      return impulses;
    }

    struct BoxSide
    {
      const char           *name;
      std::optional<double> place; // along `axis`
      int                   axis;
      double                inward; // +1: grains lie at larger values
    };

    void check_against_side(const GrainFile &file, const BoxSide &side, const double allowed_overlap)
    {
      const Grains &g = file.grains;
      for (std::size_t i = 0; i < g.size(); ++i)
        {
          const double surface   = g.position[i][side.axis] - side.inward * g.radius[i];
          const double tolerance = (g.fixed[i] ? 2. : allowed_overlap) * g.radius[i]; // a fixed grain may straddle the side
          if (side.inward * (*side.place - surface) <= tolerance)
            continue;
          const std::string axis = side.axis == 0 ? "x" : "y";
          throw std::invalid_argument(
            file.place(i) + ": " + axis + " = " + exact_text(g.position[i][side.axis]) + " with r = " + exact_text(g.radius[i]) +
            " reaches to " + exact_text(surface) + ", beyond the " + side.name + " at " + axis + " = " + exact_text(*side.place) +
            "; allowed: " + exact_text(*side.place - side.inward * tolerance) + (side.inward > 0 ? " or more" : " or less"));
        }
    }

    double relative_overlap(const Grains &g, const Contact &c)
    {
      return -c.gap / std::min(g.radius[c.i], g.radius[c.j]);
    }

    [[noreturn]] void refuse_overlap(const GrainFile &file, const Contact &worst, const int n_pairs, const double allowed)
    {
      const Grains &g   = file.grains;
      const double  sum = g.radius[worst.i] + g.radius[worst.j];
      throw std::invalid_argument(file.place(worst.i) + " and " + (file.line.empty() ? "grain " : "line ") +
                                  std::to_string(file.line.empty() ? worst.j : file.line[worst.j]) + ": the grains overlap by " +
                                  exact_text(relative_overlap(g, worst)) + " of the smaller radius, at the distance " +
                                  exact_text(sum + worst.gap) + " with radii that add to " + exact_text(sum) +
                                  "; allowed: an overlap of 0 to " + exact_text(allowed) + " (" + std::to_string(n_pairs) +
                                  (n_pairs == 1 ? " such pair)" : " such pairs; this is the worst)"));
    }

    // Refuses crowds before pairs are searched, because the pairs could be as many as all. A crowd is one cell with more grains
    // of similar size than fit, whatever overlap is allowed. Cells that are too full on average are refused, too: the number of
    // pairs grows with the sum of the squares.
    void check_crowds(const GrainFile &file, const State &state)
    {
      constexpr std::size_t most = 1000, side_by_side = 40; // without overlap there are fewer
      constexpr double      few_pairs = 1e6;
      double                sum       = 0;
      std::vector<int>      crowd;
      double                side = 0;
      for (const SizedGrid &sized : sort_by_size(state))
        {
          SearchGrid::Crowds crowds = sized.grid.crowds();
          sum += crowds.squares;
          if (crowds.fullest.size() > crowd.size())
            {
              crowd = std::move(crowds.fullest);
              side  = 2 * sized.largest_radius;
            }
        }
      if (crowd.size() <= most && sum <= std::max(few_pairs, double(side_by_side) * double(file.grains.size())))
        return;
      throw std::invalid_argument(
        file.place(crowd[0]) + " and " + (file.line.empty() ? "grain " : "line ") +
        std::to_string(file.line.empty() ? crowd[1] : file.line[crowd[1]]) + ": " + std::to_string(crowd.size()) +
        " grains of similar size lie in one square with sides of length " + exact_text(side) + ", on top of each other");
    }

    void check_overlaps(const GrainFile &file, const Periodicity &periodicity, const double allowed)
    {
      const Grains &g = file.grains;
      State         state;
      state.grains      = g;
      state.periodicity = periodicity;
      check_crowds(file, state);
      int                    n_pairs = 0;
      std::optional<Contact> worst;
      for (const Contact &c : find_contacts(state, std::vector<double>(g.size(), 0.)))
        {
          if (relative_overlap(g, c) <= allowed || (g.fixed[c.i] && g.fixed[c.j]))
            continue;
          ++n_pairs;
          if (!worst || relative_overlap(g, c) > relative_overlap(g, *worst))
            worst = c;
        }
      if (worst)
        refuse_overlap(file, *worst, n_pairs, allowed);
    }
  } // namespace

  std::string GrainFile::place(const std::size_t grain) const
  {
    return path +
           (line.empty() ? ", grain " + std::to_string(grain) + " (counted from 0)" : ", line " + std::to_string(line[grain]));
  }

  GrainFile read_grains_csv(const std::string &path, const double density, const CheckStop &check_stop)
  {
    const CsvTable csv = read_csv(path, {{"x", "y", "r"}, {"vx", "vy", "omega", "fixed"}}, check_stop);
    GrainFile      file{path, {}, csv.line};
    for (std::size_t row = 0; row < csv.rows.size(); ++row)
      add_grain_of_row(csv, row, density, file.grains);
    return file;
  }

  void write_grains_csv(const std::string &path, const Grains &g)
  {
    std::string text = "x,y,r,vx,vy,omega,fixed\n";
    for (std::size_t i = 0; i < g.size(); ++i)
      {
        for (const double value :
             {g.position[i].x(), g.position[i].y(), g.radius[i], g.velocity[i].x(), g.velocity[i].y(), g.spin[i]})
          text += exact_text(value) + ",";
        text += std::to_string(int(g.fixed[i])) + "\n";
      }
    write_text(path, text);
  }

  GrainFile read_grains_hdf5(const std::string &path, const int wanted)
  {
    const Hdf5Reader  file(path);
    const int         number = chosen_stage(file, path, wanted);
    const StageReader stage{file, path, stage_name(number)};
    const bool        of_another_code = std::isnan(file.attribute(stage.group, "step")); // imported frames have no step
    GrainFile         result{path, read_grains(stage, of_another_code)};
    StoredStage      &stored = result.stage.emplace();
    stored.number            = number;
    if (!of_another_code)
      {
        stored.time     = stage.attribute("time", -largest_magnitude);
        stored.step     = stage.attribute("step", 0.);
        stored.impulses = read_impulses(stage, result.grains.size());
      }
    stored.lower_y       = stage.attribute("lower_y", -largest_magnitude);
    stored.upper_y       = stage.attribute("upper_y", stored.lower_y);
    stored.left_x        = stage.place("left_x");
    stored.right_x       = stage.place("right_x");
    stored.mean_diameter = stage.attribute("mean_diameter", smallest_length);
    for (const int k : {0, 1, 2, 3})
      if (const double part = stage.place(std::array{"cell_a1_x", "cell_a1_y", "cell_a2_x", "cell_a2_y"}[k]); std::isfinite(part))
        stored.cell_vectors(k % 2, k / 2) = part;
    return result;
  }

  void check_grains(const GrainFile &file, const SampleBox &box, const double allowed_overlap)
  {
    const std::array<BoxSide, 4> sides = {{{"lower platen", box.lower_y, 1, 1.},
                                           {"upper platen", box.upper_y, 1, -1.},
                                           {"left wall", box.left_x, 0, 1.},
                                           {"right wall", box.right_x, 0, -1.}}};
    for (const BoxSide &side : sides)
      if (side.place)
        check_against_side(file, side, allowed_overlap);
    check_overlaps(file, box.periodicity, allowed_overlap);
  }

  TimeTable read_time_table(const std::string &path, const std::string &column)
  {
    const CsvTable csv = read_csv(path, {{"time", column}, {}, true});
    TimeTable      table;
    for (std::size_t row = 0; row < csv.rows.size(); ++row)
      {
        const double time = csv.at(row, "time");
        if (row > 0 && time <= table.time.back())
          refuse_cell(csv, row, "time", "more than " + exact_text(table.time.back()) + ", the time before it");
        table.time.push_back(time);
        table.value.push_back(csv.at(row, column));
      }
    return table;
  }
} // namespace diptych::discrete
