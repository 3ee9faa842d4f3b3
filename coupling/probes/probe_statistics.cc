// diptych: statistics of the probes: intervals, dispersion of single grains, differences between band and packs
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/probe_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <stdexcept>

#include "coupling/averaging/cell_cover.h"
#include "coupling/cells/principal_axes.h"

namespace diptych::coupling
{
  namespace
  {
    // The numbers of every resample minus those of the sample, stretched (block_bootstrap.h).
    struct ProbeReplicas
    {
      ProbeNumbers              value;
      std::vector<ProbeNumbers> deviation;
    };

    using NumberOf = double ProbeNumbers::*;

    // Treatment of a number's deviations: angles are periodic, and fabric and stress have different factors for neighbours.
    struct Treatment
    {
      NumberOf member;
      bool     is_angle, of_fabric;
    };
    const Treatment treatments[] = {{&ProbeNumbers::s1, false, false},
                                    {&ProbeNumbers::s2, false, false},
                                    {&ProbeNumbers::t_over_s, false, false},
                                    {&ProbeNumbers::direction_deg, true, false},
                                    {&ProbeNumbers::anisotropy, false, true},
                                    {&ProbeNumbers::fabric_direction_deg, true, true},
                                    {&ProbeNumbers::fabric_to_stress_deg, true, false}};

    Eigen::Vector3d components(const Eigen::Matrix2d &t)
    {
      return {t(0, 0), t(1, 1), (t(0, 1) + t(1, 0)) / std::sqrt(2.)};
    }

    // Factors for the ratios sum M / sum area and sum n (x) n / sum contacts. The influence of a block is M - ratio * area.
    struct NeighbourFactors
    {
      double stress, fabric;
    };
    NeighbourFactors neighbour_factors(const ProbeBlocks &blocks)
    {
      ProbeBlock sum;
      for (const ProbeBlock &b : blocks.block)
        {
          sum.moment += b.moment;
          sum.disc_area += b.disc_area;
          sum.normals += b.normals;
          sum.contacts += b.contacts;
        }
      std::vector<Eigen::Vector3d> stress, fabric;
      std::vector<Eigen::Vector2i> place;
      for (const ProbeBlock &b : blocks.block)
        {
          stress.push_back(components(b.moment - b.disc_area / sum.disc_area * sum.moment));
          fabric.push_back(components(b.normals - double(b.contacts) / std::max(1, sum.contacts) * sum.normals));
          place.push_back(b.place);
        }
      return {neighbour_factor(stress, place), neighbour_factor(fabric, place)};
    }

    ProbeReplicas replicas(const ProbeBlocks &blocks, const BootstrapOptions &options)
    {
      const int     n            = static_cast<int>(blocks.block.size());
      const double  small_sample = small_sample_factor(n);
      ProbeReplicas result;
      result.value                      = probe_numbers(blocks, std::vector<int>(n, 1));
      const NeighbourFactors neighbours = neighbour_factors(blocks);
      for (const std::vector<int> &times : resampled_blocks(n, options))
        {
          ProbeNumbers deviation = probe_numbers(blocks, times);
          for (const Treatment &kind : treatments)
            {
              double      &x       = deviation.*kind.member;
              const double value   = result.value.*kind.member;
              const double stretch = small_sample * (kind.of_fabric ? neighbours.fabric : neighbours.stress);
              x                    = kind.is_angle ? std::clamp(stretch * line_turn(x, value), -90., 90.) : stretch * (x - value);
            }
          result.deviation.push_back(deviation);
        }
      return result;
    }

    std::vector<double> column(const ProbeReplicas &replicas, const NumberOf member)
    {
      std::vector<double> values;
      for (const ProbeNumbers &deviation : replicas.deviation)
        values.push_back(deviation.*member);
      return values;
    }

    std::vector<double> minus(std::vector<double> a, const std::vector<double> &b)
    {
      for (std::size_t k = 0; k < a.size(); ++k)
        a[k] -= b[k];
      return a;
    }

    Interval difference(const ProbeReplicas &a, const ProbeReplicas &b, const NumberOf member)
    {
      const double value = a.value.*member - b.value.*member;
      if (a.deviation.size() != b.deviation.size()) // one of the two has too few blocks
        return {value, NAN, NAN};
      return interval_from(value, minus(column(a, member), column(b, member)));
    }

    enum class Finding
    {
      none,
      cannot_tell,
      difference
    };
    std::string words(const Finding finding)
    {
      return finding == Finding::none ? "do not differ" : finding == Finding::cannot_tell ? "cannot tell" : "differ";
    }

    std::string phrase(const std::string &name, const Interval &x, const double margin, Finding &worst)
    {
      char numbers[96];
      std::snprintf(numbers, sizeof numbers, " (%.3g, %.3g to %.3g)", x.value, x.low, x.high);
      if (!std::isfinite(x.low) || !std::isfinite(x.high))
        {
          worst = std::max(worst, Finding::cannot_tell);
          return name + ": cannot tell, too few blocks";
        }
      if (x.low > 0 || x.high < 0)
        {
          worst = Finding::difference;
          return name + " differs" + numbers;
        }
      if (x.low >= -margin && x.high <= margin)
        return name + " does not differ" + numbers;
      worst = std::max(worst, Finding::cannot_tell);
      return name + ": cannot tell" + numbers;
    }

    void judge(const ProbeMargins &margins, ProbeDifference &d)
    {
      if (const auto is_open = [](const Interval &x) { return !std::isfinite(x.low) || !std::isfinite(x.high); };
          is_open(d.t_over_s) && is_open(d.anisotropy) && is_open(d.direction_deg))
        {
          d.verdict = "cannot tell: too few blocks for an interval";
          return;
        }
      Finding           worst   = Finding::none;
      const std::string phrases = phrase("t/s", d.t_over_s, margins.t_over_s, worst) + "; " +
                                  phrase("anisotropy", d.anisotropy, margins.anisotropy, worst) + "; " +
                                  phrase("direction", d.direction_deg, margins.direction_deg, worst);
      d.verdict = words(worst) + ": " + phrases;
    }
  } // namespace

  ProbeBlocks probe_blocks(const ProbeRegion &probe, const GrainNetwork &network, const double block)
  {
    if (probe.polygon.empty())
      return {};
    const Tiles             tiles = tiles_over(probe.polygon, probe.angle_deg, block);
    std::vector<ProbeBlock> all(tiles.count());
    double                  solid_area = 0;
    for (std::size_t i = 0; i < network.position.size(); ++i)
      {
        solid_area += disc_polygon_area(network.position[i], network.radius[i], probe.polygon);
        if (!inside_polygon(network.position[i], probe.polygon))
          continue;
        ProbeBlock &its = all[tiles.tile(network.position[i])];
        its.moment += network.moment[i];
        its.disc_area += M_PI * network.radius[i] * network.radius[i];
      }
    for (const auto &contact : network.contacts)
      if (!contact.force.isZero(0) && inside_polygon(contact.point, probe.polygon))
        {
          ProbeBlock &its = all[tiles.tile(contact.point)];
          its.normals += contact.normal * contact.normal.transpose();
          ++its.contacts;
        }

    for (int k = 0; k < tiles.count(); ++k)
      all[k].place = {k % tiles.columns, k / tiles.columns};

    ProbeBlocks result;
    result.solid_fraction = solid_area / polygon_area(probe.polygon);
    for (const ProbeBlock &its : all)
      if (its.disc_area > 0 || its.contacts > 0)
        result.block.push_back(its);
    return result;
  }

  ProbeNumbers probe_numbers(const ProbeBlocks &blocks, const std::vector<int> &times)
  {
    if (times.size() != blocks.block.size())
      throw std::invalid_argument("the numbers of a probe need one count per block");
    ProbeBlock sum;
    for (std::size_t k = 0; k < times.size(); ++k)
      {
        sum.moment += times[k] * blocks.block[k].moment;
        sum.disc_area += times[k] * blocks.block[k].disc_area;
        sum.normals += times[k] * blocks.block[k].normals;
        sum.contacts += times[k] * blocks.block[k].contacts;
      }

    ProbeNumbers result;
    if (sum.disc_area > 0)
      {
        const Eigen::Matrix2d stress     = sum.moment / sum.disc_area * blocks.solid_fraction;
        const double          difference = principal_difference(stress);
        result.s1                        = 0.5 * (stress.trace() + difference);
        result.s2                        = 0.5 * (stress.trace() - difference);
        result.t_over_s                  = difference / stress.trace();
        result.direction_deg             = major_direction(stress);
      }
    if (sum.contacts > 0)
      {
        result.anisotropy           = 2 * principal_difference(sum.normals) / sum.contacts;
        result.fabric_direction_deg = major_direction(sum.normals);
        result.fabric_to_stress_deg = line_turn(result.fabric_direction_deg, result.direction_deg);
      }
    return result;
  }

  ProbeIntervals probe_intervals(const ProbeBlocks &blocks, const BootstrapOptions &options)
  {
    const ProbeReplicas all = replicas(blocks, options);
    const auto          of  = [&](const NumberOf member) { return interval_from(all.value.*member, column(all, member)); };
    ProbeIntervals      result;
    result.s1                   = of(&ProbeNumbers::s1);
    result.s2                   = of(&ProbeNumbers::s2);
    result.t_over_s             = of(&ProbeNumbers::t_over_s);
    result.direction_deg        = of(&ProbeNumbers::direction_deg);
    result.anisotropy           = of(&ProbeNumbers::anisotropy);
    result.fabric_direction_deg = of(&ProbeNumbers::fabric_direction_deg);
    result.fabric_to_stress_deg = of(&ProbeNumbers::fabric_to_stress_deg);
    result.blocks               = static_cast<int>(blocks.block.size());
    for (Interval *size : {&result.t_over_s, &result.anisotropy})
      size->low = std::max(size->low, std::isnan(size->low) ? size->low : 0.);
    return result;
  }

  GrainPressure grain_pressure(const ProbeRegion &probe, const GrainNetwork &network)
  {
    std::vector<double> pressure;
    for (std::size_t i = 0; i < network.position.size(); ++i)
      if (inside_polygon(network.position[i], probe.polygon))
        pressure.push_back(0.5 * network.moment[i].trace() / (M_PI * network.radius[i] * network.radius[i]));

    GrainPressure result;
    result.grains = static_cast<int>(pressure.size());
    if (pressure.empty())
      return result;
    result.mean    = std::accumulate(pressure.begin(), pressure.end(), 0.) / pressure.size();
    double squares = 0;
    for (const double p : pressure)
      squares += (p - result.mean) * (p - result.mean);
    if (pressure.size() > 1)
      result.deviation = std::sqrt(squares / (pressure.size() - 1));
    for (std::size_t k = 0; k < percentile_levels.size(); ++k)
      result.percentiles[k] = quantile(pressure, 0.01 * percentile_levels[k]);
    return result;
  }

  std::vector<ProbeDifference> probe_differences(const std::vector<ProbeRegion> &probes,
                                                 const std::vector<ProbeBlocks> &blocks,
                                                 const BootstrapOptions         &options,
                                                 const ProbeMargins             &margins)
  {
    if (blocks.size() != probes.size())
      throw std::invalid_argument("the differences of probes need the blocks of every probe");
    const auto        zone  = std::find_if(probes.begin(), probes.end(), [](const auto &p) { return p.is_zone; });
    const std::size_t first = zone == probes.end() ? 0 : zone - probes.begin();

    std::vector<ProbeReplicas> all;
    BootstrapOptions           own = options;
    for (std::size_t k = 0; k < blocks.size(); ++k, ++own.seed)
      all.push_back(replicas(blocks[k], own));

    std::vector<ProbeDifference> result;
    for (std::size_t k = 0; k < probes.size(); ++k)
      {
        if (k == first || blocks[k].block.empty() || blocks[first].block.empty())
          continue;
        ProbeDifference d{probes[first].name,
                          probes[k].name,
                          difference(all[first], all[k], &ProbeNumbers::t_over_s),
                          difference(all[first], all[k], &ProbeNumbers::anisotropy),
                          {},
                          {}};
        const double    turn = line_turn(all[first].value.direction_deg, all[k].value.direction_deg);
        d.direction_deg      = difference(all[first], all[k], &ProbeNumbers::direction_deg);
        const double shift   = turn - d.direction_deg.value; // a whole number of half turns
        d.direction_deg      = {turn, d.direction_deg.low + shift, d.direction_deg.high + shift};
        judge(margins, d);
        result.push_back(d);
      }
    return result;
  }
} // namespace diptych::coupling
