// diptych: isotropic elasticity in plane strain, classical and Cosserat
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/elasticity.h"

namespace diptych::continuum
{
  ElasticModuli elastic_moduli(const LawOptions &options, const bool is_cosserat)
  {
    ElasticModuli m;
    m.shear      = options.elastic.youngs_modulus / (2 * (1 + options.elastic.poisson_ratio));
    m.bulk       = options.elastic.youngs_modulus / (3 * (1 - 2 * options.elastic.poisson_ratio));
    m.plane_bulk = m.bulk + m.shear / 3;
    m.lateral    = m.bulk - 2 * m.shear / 3;
    if (is_cosserat)
      {
        m.couple = 2 * m.shear * options.internal_length * options.internal_length;
        m.skew   = options.couple_shear_ratio * m.shear;
      }
    return m;
  }

  Tangent elastic_tangent(const ElasticModuli &moduli)
  {
    Tangent c;
    c[xx][xx] = c[yy][yy] = moduli.plane_bulk + moduli.shear;
    c[xx][yy] = c[yy][xx]                   = moduli.plane_bulk - moduli.shear;
    c[xy][xy]                               = moduli.shear;
    c[relative_rotation][relative_rotation] = moduli.skew;
    c[curvature_x][curvature_x] = c[curvature_y][curvature_y] = moduli.couple;
    return c;
  }
} // namespace diptych::continuum
