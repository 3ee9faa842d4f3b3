// diptych: loss of ellipticity of a tangent, the onset of a band and its direction
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/localisation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace diptych::continuum
{
  namespace
  {
    constexpr double pi = 3.14159265358979323846;

    // f(phi) = mean + c1 cos(phi) + s1 sin(phi) + c2 cos(2 phi) + s2 sin(2 phi), phi = 2 theta, n = (cos theta, sin theta).
    struct Harmonics
    {
      double mean, c1, s1, c2, s2;
    };

    // A component of Q: p cos^2 + q cos sin + r sin^2.
    struct Quadratic
    {
      double p, q, r;
    };

    // With the stress vector (xx, yy, xy) the traction is N^T stress, N = [cos 0; 0 sin; sin cos]. The strain of a jump g is N
    // g, so Q = N^T D N.
    std::array<Quadratic, 4> acoustic_tensor(const Tangent &d)
    {
      return {Quadratic{d[xx][xx], d[xx][xy] + d[xy][xx], d[xy][xy]}, Quadratic{d[xx][xy], d[xx][yy] + d[xy][xy], d[xy][yy]},
              Quadratic{d[xy][xx], d[yy][xx] + d[xy][xy], d[yy][xy]}, Quadratic{d[xy][xy], d[xy][yy] + d[yy][xy], d[yy][yy]}};
    }

    // Coefficients of cos^4, cos^3 sin, cos^2 sin^2, cos sin^3, sin^4.
    std::array<double, 5> product(const Quadratic &a, const Quadratic &b)
    {
      return {a.p * b.p, a.p * b.q + a.q * b.p, a.p * b.r + a.q * b.q + a.r * b.p, a.q * b.r + a.r * b.q, a.r * b.r};
    }

    Harmonics determinant(const Tangent &tangent)
    {
      const auto            q = acoustic_tensor(tangent);
      std::array<double, 5> a = product(q[0], q[3]), b = product(q[1], q[2]);
      for (unsigned int k = 0; k < 5; ++k)
        a[k] -= b[k];
      // cos^2 = (1 + cos phi)/2, sin^2 = (1 - cos phi)/2, cos sin = sin(phi)/2
      Harmonics f;
      f.mean = (3 * (a[0] + a[4]) + a[2]) / 8;
      f.c1   = (a[0] - a[4]) / 2;
      f.s1   = (a[1] + a[3]) / 4;
      f.c2   = (a[0] - a[2] + a[4]) / 8;
      f.s2   = (a[1] - a[3]) / 8;
      return f;
    }

    struct Direction
    {
      double phi, value;
    };

    constexpr unsigned int n_directions = 16;
    constexpr double       spacing      = 2 * pi / n_directions;
    // No direction of the scan lies on an axis, because there the two minima of an aligned coaxial state merge at a maximum.
    constexpr double offset = 0.1;

    struct Directions
    {
      std::array<double, n_directions> c1, s1, c2, s2;

      Directions()
      {
        for (unsigned int k = 0; k < n_directions; ++k)
          {
            const double phi = offset + k * spacing;
            c1[k]            = std::cos(phi);
            s1[k]            = std::sin(phi);
            c2[k]            = std::cos(2 * phi);
            s2[k]            = std::sin(2 * phi);
          }
      }
    };

    std::array<double, n_directions> scan(const Harmonics &f)
    {
      static const Directions          d;
      std::array<double, n_directions> values;
      for (unsigned int k = 0; k < n_directions; ++k)
        values[k] = f.mean + f.c1 * d.c1[k] + f.s1 * d.s1[k] + f.c2 * d.c2[k] + f.s2 * d.s2[k];
      return values;
    }

    // Finds the minimum near `phi` by Newton's method on f' = 0. Where f is not convex, it takes a fixed step downhill.
    Direction refined(const Harmonics &f, double phi)
    {
      double value = 0;
      for (unsigned int iteration = 0; iteration < 20; ++iteration)
        {
          const double c1 = std::cos(phi), s1 = std::sin(phi), c2 = c1 * c1 - s1 * s1, s2 = 2 * s1 * c1;
          const double slope     = -f.c1 * s1 + f.s1 * c1 + 2 * (f.s2 * c2 - f.c2 * s2);
          const double curvature = -f.c1 * c1 - f.s1 * s1 - 4 * (f.c2 * c2 + f.s2 * s2);
          value                  = f.mean + f.c1 * c1 + f.s1 * s1 + f.c2 * c2 + f.s2 * s2;
          const double step      = curvature > 0 ? std::clamp(-slope / curvature, -spacing / 2, spacing / 2)
                                                 : -std::copysign(spacing / 4, slope);
          if (std::abs(step) < 1e-5) // this step makes the angle exact to 1e-10 and the value exact to round-off
            return {phi + step, value + slope * step / 2};
          phi += step;
        }
      return {phi, value};
    }

    // Angle of the line perpendicular to n = (cos phi/2, sin phi/2). `phi` is at most slightly outside [0, 2 pi].
    double line_angle(const double phi)
    {
      const double angle = phi / 2 * 180 / pi - 90;
      return angle <= -90 ? angle + 180 : angle > 90 ? angle - 180 : angle;
    }
  } // namespace

  Localisation localisation(const Tangent &tangent, const Tangent &elastic)
  {
    const double scale = 1 / (elastic[xx][xx] * elastic[xy][xy]); // isotropic: det Q = (lambda + 2 mu) mu
    Harmonics    f     = determinant(tangent);
    for (double *coefficient : {&f.mean, &f.c1, &f.s1, &f.c2, &f.s2})
      *coefficient *= scale;
    constexpr double same = 1e-9; // tolerance of equal determinants
    if (!(std::abs(f.c1) + std::abs(f.s1) + std::abs(f.c2) + std::abs(f.s2) > same))
      return {f.mean, 0.};

    // f has at most two minima, each in a dip of the scan. The search starts at the vertex of the parabola.
    const auto   values = scan(f);
    Localisation least{std::numeric_limits<double>::infinity(), 0.};
    for (unsigned int k = 0; k < n_directions; ++k)
      {
        const double before = values[(k + n_directions - 1) % n_directions], here = values[k],
                     after = values[(k + 1) % n_directions];
        if (!(here < before && here <= after))
          continue;
        const double    vertex  = (before - after) / (before - 2 * here + after) / 2;
        const Direction minimum = refined(f, offset + (k + vertex) * spacing);
        const double    angle   = line_angle(minimum.phi);
        if (minimum.value < least.determinant - same || (minimum.value < least.determinant + same && angle > least.angle_deg))
          least = {minimum.value, angle};
      }
    return least;
  }
} // namespace diptych::continuum
