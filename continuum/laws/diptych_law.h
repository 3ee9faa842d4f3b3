/* diptych: a constitutive law of your own as a shared library; C99 and C++
 * SPDX-License-Identifier: LGPL-2.1-or-later
 *
 * SIGNS   Tension is positive, in stress and in strain, as in UMAT and MFront. Result files are positive in compression: the
 *         panel converts stress and plastic strain. State variables are stored with the sign that the law gives them.
 * ORDER   strain: e_xx, e_yy, gamma_xy = 2 e_xy; stress: s_xx, s_yy, s_xy. Plane strain: e_zz = 0, s_zz has its own place.
 *         A Cosserat law has six components. strain: then the relative rotation (du_y/dx - du_x/dy) - 2 omega and the curvatures
 *         d omega/dx, d omega/dy; stress: then the skew part a and the couple stresses m_x, m_y [pressure * length]. With row =
 *         component of the force and column = normal of the face, s_xy = symmetric part - a and s_yx = symmetric part + a.
 * UNITS   Stress has the unit of loading/pressure of the scene, length that of sample/mean_diameter.
 *
 * A library exports diptych_law_describe and diptych_law_update, and diptych_law_start if its state variables depend on the
 * initial stress or on parameters. It keeps no state between calls: everything comes in and goes out through the arguments. It
 * may be called from several processes or threads. In C++ put the functions into extern "C" { }; the declarations below do so.
 *
 *     cc -shared -fPIC -O2 -I/usr/include/diptych -o mylaw.so mylaw.c
 *     diptych check-law mylaw.so
 */
#ifndef DIPTYCH_LAW_H
#define DIPTYCH_LAW_H

#ifdef __cplusplus
extern "C" {
#endif

/* Version of this interface. A program refuses libraries of another version. */
#define DIPTYCH_LAW_INTERFACE 1

/* Units of a parameter that the panel converts: a scene gives such stresses as multiples of loading/pressure and such lengths as
 * multiples of sample/mean_diameter; the law receives stresses and lengths. Any other unit is only text. */
#define DIPTYCH_STRESS "loading/pressure"
#define DIPTYCH_LENGTH "mean diameters"

/* A scene sets it as `set law.NAME = VALUE` in the section continuum. */
struct diptych_parameter
{
  const char *name; /* letters, digits and _ */
  const char *unit;
  const char *meaning;
  double      usual; /* the value if the scene gives none */
  double      least, greatest;
};

/* Turned with the material in `geometry = updated`: three consecutive variables xx, yy, xy (not 2 xy) of a symmetric tensor,
 * the first of which has kind DIPTYCH_TENSOR and the others DIPTYCH_SCALAR. */
enum diptych_kind
{
  DIPTYCH_SCALAR,
  DIPTYCH_TENSOR
};

/* A state variable. Results contain it as law.NAME. A refined mesh interpolates it between the points of the divided element,
 * within their range. */
struct diptych_variable
{
  const char       *name; /* letters, digits and _ */
  const char       *unit;
  const char       *meaning;
  double            start; /* diptych_law_start can replace it */
  enum diptych_kind kind;
};

struct diptych_law
{
  int                             interface_version; /* DIPTYCH_LAW_INTERFACE */
  int                             n_components;      /* 3, or 6 for a Cosserat law */
  int                             n_parameters;
  const struct diptych_parameter *parameters;
  int                             n_variables; /* at most DIPTYCH_MOST_VARIABLES */
  const struct diptych_variable  *variables;
};

#define DIPTYCH_MOST_VARIABLES 64

/* State at the start of a step, and the step. */
struct diptych_step
{
  const double *parameters; /* in the order of the description, converted */
  const double *stress;     /* n_components */
  double        stress_zz;
  double        hardening; /* hardening variable: integral of the plastic d(eps_1 - eps_3); a weak spot raises its start */
  const double *variables; /* n_variables */
  const double *strain;    /* increment, n_components */
  double        time;      /* length of the step along the loading (strain or time); only for viscosity. 0: rate independent */
};

enum diptych_branch
{
  DIPTYCH_ELASTIC,
  DIPTYCH_PLASTIC, /* the panel looks for the onset of a band */
  DIPTYCH_TIP      /* nearly no stiffness, as at the tip of a cone: the panel adds a thousandth of the elastic one */
};

/* State at the end. On entry it holds the state at the start, a tangent of zeros and the branch DIPTYCH_ELASTIC. */
struct diptych_answer
{
  double             *stress; /* n_components */
  double              stress_zz;
  double              hardening;         /* results and adaptive refinement use it */
  double             *variables;         /* n_variables */
  double             *tangent;           /* d stress / d strain increment, n_components x n_components, row by row */
  double              plastic_strain[4]; /* increments xx, yy, zz and 2 xy, or zeros: only for results */
  double              dissipation;       /* increment of the plastic work per area [pressure], or zero: only for results */
  enum diptych_branch branch;
};

enum diptych_verdict
{
  DIPTYCH_RELIABLE,
  DIPTYCH_UNRELIABLE, /* the answer may not be unique: results show the share of the area */
  DIPTYCH_FAILED      /* no answer: the load step is halved. A NaN has the same effect. */
};

/* The description must stay valid while the library is loaded. */
const struct diptych_law *diptych_law_describe(void);

enum diptych_verdict diptych_law_update(const struct diptych_step *step, struct diptych_answer *answer);

/* Optional. Sets the state variables of a point before loading; on entry they hold their `start`. */
void diptych_law_start(const double *parameters, const double *stress, double stress_zz, double *variables);

#ifdef __cplusplus
}
#endif

#endif
