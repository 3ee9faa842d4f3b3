// diptych: keys of the sample and of its preparation
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/samples/sample_options.h"

#include <cmath>
#include <stdexcept>

#include "discrete/files/csv_file.h"

namespace diptych::discrete
{
  namespace
  {
    RadiusDistribution distribution(const SampleOptions &o)
    {
      if (o.radius_distribution == RadiusKind::uniform_by_mass)
        return UniformByMass{o.radius_min, o.radius_max};
      if (o.radius_distribution == RadiusKind::table)
        return read_radius_table(o.radius_table);
      return UniformByNumber{o.radius_min, o.radius_max};
    }

    void check_size(const SampleOptions &o)
    {
      constexpr double fewest = 10, most = 1e7;
      if (const double n = expected_grains(o); !(n >= fewest && n <= most))
        throw WrongKeys({"sample/width", "sample/height"},
                        "sample/width and sample/height hold " + exact_text(std::round(n)) + " grains; allowed: 10 to 1e+07");
      const Eigen::Vector2d size = expected_size(o);
      if (const double least = 2 * sorted_radii(o, 1000).back(); !(size.minCoeff() >= least))
        throw WrongKeys({"sample/width", "sample/height", "sample/width_over_height"},
                        "sample/width, height and width_over_height make a sample of " + exact_text(size.x()) + " x " +
                          exact_text(size.y()) + "; both must be at least the diameter of the largest grain, " +
                          exact_text(least));
    }
  } // namespace

  std::vector<double> sorted_radii(const SampleOptions &o, const int n)
  {
    std::vector<double> radius = radius_quantiles(distribution(o), n, RadiusScale::mean_diameter_one);
    for (double &r : radius)
      r *= o.mean_diameter;
    return radius;
  }

  double disc_area(const std::vector<double> &radius)
  {
    double area = 0;
    for (const double r : radius)
      area += M_PI * r * r;
    return area;
  }

  Eigen::Vector2d sample_size(const SampleOptions &o, const double area)
  {
    const double whole = area / o.solid_fraction;
    if (o.width > 0)
      return {o.width, o.height > 0 ? o.height : whole / o.width};
    if (o.height > 0)
      return {whole / o.height, o.height};
    const double height = std::sqrt(whole / o.width_over_height);
    return {whole / height, height};
  }

  double expected_grains(const SampleOptions &o)
  {
    if (o.width <= 0 || o.height <= 0)
      return o.grains;
    const std::vector<double> radius = sorted_radii(o, 1000);
    return o.width * o.height * o.solid_fraction / (disc_area(radius) / double(radius.size()));
  }

  Eigen::Vector2d expected_size(const SampleOptions &o)
  {
    const std::vector<double> radius = sorted_radii(o, 1000);
    return sample_size(o, disc_area(radius) / double(radius.size()) * expected_grains(o));
  }

  void validate(const SampleOptions &o)
  {
    if (o.radius_distribution == RadiusKind::uniform_by_number && std::abs(o.radius_min + o.radius_max - 1) > 1e-9)
      throw WrongKeys({"sample/radius_min", "sample/radius_max"},
                      "sample/radius_min + sample/radius_max is " + exact_text(o.radius_min + o.radius_max) +
                        " mean diameters; it must be 1, so that radii uniform by number have the mean diameter 1");
    if (o.radius_distribution != RadiusKind::table && o.radius_max < o.radius_min)
      throw WrongKeys({"sample/radius_max", "sample/radius_min"},
                      "sample/radius_max = " + exact_text(o.radius_max) +
                        " is less than sample/radius_min = " + exact_text(o.radius_min));
    if (o.box_solid_fraction > o.solid_fraction)
      throw WrongKeys({"sample/box_solid_fraction", "sample/solid_fraction"},
                      "sample/box_solid_fraction " + exact_text(o.box_solid_fraction) + " exceeds sample/solid_fraction " +
                        exact_text(o.solid_fraction));
    if (o.radius_distribution == RadiusKind::table && o.radius_table.empty())
      throw WrongKeys({"sample/radius_distribution", "sample/radius_table"},
                      "sample/radius_distribution = table: sample/radius_table must name the CSV file");
    if (!o.radius_table.empty() && o.radius_distribution != RadiusKind::table)
      throw WrongKeys({"sample/radius_table", "sample/radius_distribution"},
                      "sample/radius_table = '" + o.radius_table +
                        "' is used only with sample/radius_distribution = table, not " + name_of(o.radius_distribution));
    if (o.radius_distribution == RadiusKind::table)
      (void)read_for("radius_table", o.radius_table, read_radius_table);
    if (o.file.empty())
      check_size(o);
    if (o.lower_platen && o.upper_platen && *o.lower_platen >= *o.upper_platen)
      throw WrongKeys({"sample/lower_platen", "sample/upper_platen"}, "sample/lower_platen is not below sample/upper_platen");
    if (o.left_wall && o.right_wall && *o.left_wall >= *o.right_wall)
      throw WrongKeys({"sample/left_wall", "sample/right_wall"}, "sample/left_wall is not left of sample/right_wall");
  }
} // namespace diptych::discrete
