// diptych: stresses of single grains inside and outside the shear band: do the force chains differ there?
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/force_chains.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "coupling/cells/principal_axes.h"

namespace diptych::coupling
{
  namespace
  {
    struct Value
    {
      double value;
      bool   inside;
      int    tile;
    };

    struct Values
    {
      std::vector<Value>           all;   // ascending, relative to their mean
      std::vector<Eigen::Vector2i> place; // column and row of the tiles that hold a value, numbered from 0
    };

    Values values_of(const BandZone                     &zone,
                     const std::vector<Eigen::Vector2d> &outline,
                     const GrainNetwork                 &network,
                     const double                        margin,
                     const double                        block)
    {
      const Tiles   tiles = tiles_over(outline, zone.angle_deg, block);
      Values        values;
      std::set<int> used;
      for (std::size_t i = 0; i < network.position.size(); ++i)
        {
          const Eigen::Vector2d &place = network.position[i];
          if (!inside_polygon(place, outline) || distance_to_edges(place, outline) < margin)
            continue;
          const Eigen::Matrix2d &moment = network.moment[i];
          const double           major  = 0.5 * (std::abs(moment.trace()) + principal_difference(moment));
          const int              tile   = tiles.tile(place);
          values.all.push_back({major / (M_PI * network.radius[i] * network.radius[i]), zone.holds(place), tile});
          used.insert(tile);
        }
      for (const int tile : used)
        values.place.emplace_back(tile % tiles.columns, tile / tiles.columns);
      double mean = 0;
      for (const Value &v : values.all)
        mean += v.value / values.all.size();
      for (Value &v : values.all)
        {
          v.value = mean > 0 ? v.value / mean : 0;
          v.tile  = static_cast<int>(std::distance(used.begin(), used.find(v.tile)));
        }
      std::stable_sort(values.all.begin(), values.all.end(), [](const Value &a, const Value &b) { return a.value < b.value; });
      return values;
    }

    ChainDistribution distribution(const std::vector<Value> &all, const bool inside)
    {
      std::vector<double> values;
      for (const Value &v : all)
        if (v.inside == inside)
          values.push_back(v.value);
      ChainDistribution result;
      result.count = static_cast<int>(values.size());
      result.values.fill(NAN);
      if (values.empty())
        return result;
      double sum = 0, above = 0;
      for (const double v : values)
        {
          sum += v;
          above += v > 1;
        }
      result.mean             = sum / values.size();
      result.share_above_mean = above / values.size();
      for (std::size_t k = 0; k < chain_quantiles.size(); ++k)
        result.values[k] = quantile(values, chain_quantiles[k]);
      return result;
    }

    // Cumulative share inside minus outside at every value; `times` says how often each tile counts. For equal values only the
    // last entry belongs to the distributions, so the others are set to it.
    std::vector<double> cumulative_difference(const std::vector<Value> &all, const std::vector<int> &times)
    {
      double total[2] = {0, 0}, sum[2] = {0, 0};
      for (const Value &v : all)
        total[v.inside] += times[v.tile];
      std::vector<double> difference(all.size(), NAN);
      if (!(total[0] > 0 && total[1] > 0))
        return difference;
      for (std::size_t k = 0; k < all.size(); ++k)
        {
          sum[all[k].inside] += times[all[k].tile];
          difference[k] = sum[1] / total[1] - sum[0] / total[0];
        }
      for (std::size_t k = all.size() - 1; k-- > 0;)
        if (all[k].value == all[k + 1].value)
          difference[k] = difference[k + 1];
      return difference;
    }

    // Stretching factor for the correlation of neighbouring tiles, from the difference of the two distributions at their common
    // quartiles.
    double stretch_by_neighbours(const Values &values, const int n_inside, const int n_outside)
    {
      const std::vector<Value>    &all = values.all;
      std::vector<Eigen::Vector3d> influence(values.place.size(), Eigen::Vector3d::Zero());
      for (int q = 0; q < 3; ++q)
        {
          const double at       = all[(q + 1) * all.size() / 4].value;
          double       below[2] = {0, 0};
          for (const Value &v : all)
            below[v.inside] += v.value <= at;
          for (const Value &v : all)
            influence[v.tile][q] += v.inside ? ((v.value <= at) - below[1] / n_inside) / n_inside
                                             : -((v.value <= at) - below[0] / n_outside) / n_outside;
        }
      return neighbour_factor(influence, values.place);
    }

    double largest_size(const std::vector<double> &values)
    {
      double largest = 0;
      for (const double v : values)
        largest = std::isnan(v) ? NAN : std::max(largest, std::abs(v)); // either all are NaN or none
      return largest;
    }

    int smaller_number_of_blocks(const std::vector<Value> &all)
    {
      std::set<int> tiles[2];
      for (const Value &v : all)
        tiles[v.inside].insert(v.tile);
      return static_cast<int>(std::min(tiles[0].size(), tiles[1].size()));
    }

    std::string verdict(const ForceChains &chains)
    {
      const Interval &d = chains.largest_distance;
      char            text[160];
      if (!std::isfinite(d.high))
        return "cannot tell: too few blocks";
      if (d.low > 0)
        std::snprintf(text, sizeof text,
                      "differs: largest distance of the distributions %.2g (%.2g to %.2g), mean inside %.3g times outside",
                      d.value, d.low, d.high, chains.inside.mean / chains.outside.mean);
      else if (d.high <= chain_margin)
        std::snprintf(text, sizeof text, "ignores the zone: the distributions differ by %.2g at most", d.high);
      else
        std::snprintf(text, sizeof text, "cannot tell: largest distance %.2g; up to %.2g cannot be excluded", d.value, d.high);
      return text;
    }

    // 95 % quantile of the largest difference that arises by chance.
    double scatter(const Values &values, const ForceChains &chains, const BootstrapOptions &options)
    {
      const int                 n_tiles = static_cast<int>(values.place.size());
      const std::vector<double> own     = cumulative_difference(values.all, std::vector<int>(n_tiles, 1));
      std::vector<double>       largest;
      for (const std::vector<int> &times : resampled_blocks(n_tiles, options))
        {
          std::vector<double> drawn = cumulative_difference(values.all, times);
          for (std::size_t k = 0; k < drawn.size(); ++k)
            drawn[k] -= own[k];
          if (const double size = largest_size(drawn); std::isfinite(size))
            largest.push_back(size);
        }
      return small_sample_factor(chains.blocks) * stretch_by_neighbours(values, chains.inside.count, chains.outside.count) *
             quantile(largest, 0.95);
    }

  } // namespace

  ForceChains grain_force_chains(const BandZone                     &zone,
                                 const std::vector<Eigen::Vector2d> &outline,
                                 const GrainNetwork                 &network,
                                 const double                        margin,
                                 const BootstrapOptions             &options)
  {
    const Values values = values_of(zone, outline, network, margin, options.block);
    ForceChains  chains;
    chains.inside  = distribution(values.all, true);
    chains.outside = distribution(values.all, false);
    chains.blocks  = smaller_number_of_blocks(values.all);
    if (chains.inside.count > 0 && chains.outside.count > 0)
      {
        const double d          = largest_size(cumulative_difference(values.all, std::vector<int>(values.place.size(), 1)));
        const double c          = scatter(values, chains, options);
        chains.largest_distance = {d, std::isnan(c) ? c : std::max(0., d - c), std::isnan(c) ? c : std::min(1., d + c)};
      }
    chains.verdict = verdict(chains);
    return chains;
  }
} // namespace diptych::coupling
