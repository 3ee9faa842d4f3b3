// diptych: plastic strain and plastic work of a step
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/plastic_flow.h"

#include <cmath>

namespace diptych::continuum
{
  void add_plastic_flow(const ElasticModuli &moduli, const MaterialState &s0, const Strain &d_strain, MaterialState &s1)
  {
    if (moduli.bulk == 0) // a law from a library reports its flow itself
      return;
    // Elastic strain in three dimensions: deviator / 2 G + I1 / 9 K.
    const Stress d_stress = s1.stress - s0.stress;
    const double d_zz     = s1.stress_zz - s0.stress_zz;
    const double mean     = (d_stress[xx] + d_stress[yy] + d_zz) / 3;
    const auto   normal   = [&](const double d) { return (d - mean) / (2 * moduli.shear) + mean / (3 * moduli.bulk); };

    PlasticStrain d;
    d.xx = d_strain[xx] - normal(d_stress[xx]);
    d.yy = d_strain[yy] - normal(d_stress[yy]);
    d.zz = -normal(d_zz);
    d.xy = d_strain[xy] - d_stress[xy] / moduli.shear;

    s1.plastic_strain.xx += d.xx;
    s1.plastic_strain.yy += d.yy;
    s1.plastic_strain.zz += d.zz;
    s1.plastic_strain.xy += d.xy;
    s1.dissipation += s1.stress[xx] * d.xx + s1.stress[yy] * d.yy + s1.stress_zz * d.zz + s1.stress[xy] * d.xy;
    if (moduli.couple > 0)
      for (const Component k : {curvature_x, curvature_y})
        s1.dissipation += s1.stress[k] * (d_strain[k] - d_stress[k] / moduli.couple);
  }

  bool weakens_contracting(const ElasticModuli &moduli, const MaterialState &s0, const Strain &d_strain, const MaterialState &s1)
  {
    constexpr double none = 1e-9; // relative to the elastic work of this strain; perfect plasticity has 0
    double           work = 0, size = 0;
    for (const Component k : {xx, yy, xy})
      {
        work += (s1.stress[k] - s0.stress[k]) * d_strain[k];
        size += d_strain[k] * d_strain[k];
      }
    const double growth = s1.plastic_strain.xx - s0.plastic_strain.xx + s1.plastic_strain.yy - s0.plastic_strain.yy;
    return growth < -none * std::sqrt(size) && work < -none * moduli.shear * size;
  }
} // namespace diptych::continuum
