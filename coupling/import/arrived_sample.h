// diptych: an imported sample in order, and the results of its checks
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>
#include <type_traits>
#include <vector>

#include "coupling/import/foreign_sample.h"
#include "coupling/numbers/number_entry.h"

namespace diptych::coupling
{
  // One instant. Grains are in ascending order of their ids, the same in all frames. Bodies of contacts are numbered as in a
  // Snapshot (after the grains the walls: lower, upper, left, right). Forces and masses are per unit thickness. NaN: not in the
  // files.
  struct ArrivedFrame
  {
    std::string                          name;
    std::string                          grain_file, wall_file; // for messages
    double                               time = not_told;
    long                                 step = 0;
    std::vector<Eigen::Vector2d>         position, velocity, resultant;
    std::vector<Eigen::Vector2d>         weight; // 0 without gravity
    std::vector<double>                  radius, mass, rotation, spin;
    std::vector<discrete::ContactForce>  contacts; // with a force
    std::vector<discrete::ContactStatus> status;
    bool                                 has_contacts = false;
    std::array<double, 4>                wall         = {not_told, not_told, not_told, not_told}; // places, indexed by Side
    std::array<Eigen::Vector2d, 4>       wall_force;           // on the sample: sum of contacts, or from a table
    std::array<Eigen::Vector2d, 4>       told_wall_force;      // from a table
    double                               upper_travel = 0;     // of the upper wall, to the right, since the first frame
    double                               overlap_miss = 0;     // largest difference between overlaps in the file and of the discs
    double                               wall_miss    = 0;     // largest distance of a wall from its contact points
    double                               widest_gap   = 0;     // largest gap between two bodies in contact
    bool                                 walls_touch  = false; // a wall was placed at the outermost grains
    double                               point_miss   = 0;     // largest distance of a contact point from where the surfaces meet
  };

  // Results of the checks of one frame. Stresses are positive in compression.
  struct ArrivalCheck
  {
    std::string     name;
    double          time = not_told, axial_strain = not_told;
    int             grains = 0, contacts = 0; // between grains, with a force
    int             lower_contacts = 0, upper_contacts = 0, left_contacts = 0, right_contacts = 0;
    double          mass = not_told, solid_fraction = not_told;
    bool            against_resultants = false;
    double          balance_rms = not_told, balance_worst = not_told;
    long            balance_worst_grain = 0;
    Eigen::Vector2d balancing_gravity   = {not_told, not_told}; // that would halve a residual without weight
    Eigen::Matrix2d contact_stress = Eigen::Matrix2d::Constant(not_told), wall_stress = contact_stress;
    double          stress_difference = not_told, wall_force_difference = not_told, largest_overlap = not_told;
  };

  template <class Check, class Visitor, std::enable_if_t<std::is_same_v<std::remove_const_t<Check>, ArrivalCheck>, int> = 0>
  void list_numbers(Check &c, Visitor &v)
  {
    v({"frame", "-", "name of the frame in the files", Kind::setting}, c.name);
    v({"time", "time", "time of the frame; null: not in the files"}, c.time);
    v({"axial_strain", "-", "descent of the upper wall / height in the first frame"}, c.axial_strain);
    v({"grains", "-", "number of grains"}, c.grains);
    v({"contacts", "-", "number of contacts between grains with a force"}, c.contacts);
    v({"lower_contacts", "-", "number of contacts with the lower wall with a force"}, c.lower_contacts);
    v({"upper_contacts", "-", "number of contacts with the upper wall with a force"}, c.upper_contacts);
    v({"left_contacts", "-", "number of contacts with the left wall with a force"}, c.left_contacts);
    v({"right_contacts", "-", "number of contacts with the right wall with a force"}, c.right_contacts);
    v({"mass", "mass", "mass of all grains, per unit thickness"}, c.mass);
    v({"solid_fraction", "-", "area of the grains / area between the walls"}, c.solid_fraction);
    v({"balance_against_resultants", "-", "true: contact forces are compared with the resultant in the file; false: with zero"},
      c.against_resultants);
    v({"balance_rms", "-",
       "rms over grains of contact forces plus weight minus resultant (or 0) / mean contact force; without resultants and with "
       "free sides only the vertical component counts"},
      c.balance_rms);
    v({"balance_worst", "-", "largest such residual of a grain"}, c.balance_worst);
    v({"balance_worst_grain", "-", "id of that grain", Kind::setting}, c.balance_worst_grain);
    v({"contact_stress", "pressure", "sum over contacts of force (x) branch / area"}, c.contact_stress);
    v({"wall_stress", "pressure",
       "sum over wall contacts of force on the wall (x) contact point, less weights (x) centres, / area"},
      c.wall_stress);
    v({"stress_difference", "-",
       "largest component of their difference / largest component of the wall stress; inertia or an error"},
      c.stress_difference);
    v({"wall_force_difference", "-", "wall forces in the files against the sums of contacts, relative"}, c.wall_force_difference);
    v({"largest_overlap", "mean diameters", "largest overlap of two grains or of a grain and a wall"}, c.largest_overlap);
  }

  struct Arrival
  {
    std::string               format;
    std::vector<long>         id; // of the grains
    std::vector<ArrivedFrame> frames;
    std::vector<ArrivalCheck> checks;
    double                    thickness = 1, mean_diameter = not_told, density = not_told; // [mass / length^2 per unit thickness]
    std::vector<std::string>  remarks;  // notes on data that were reordered, reversed or left out
    std::vector<std::string>  lacking;  // quantities that the files do not contain; null in all results
    std::vector<std::string>  doubtful; // findings of the checks that a user should look at
  };

  void remark_once(Arrival &arrival, const std::string &text);

  // Fills contacts, status and walls of `to`; its grains are already there, in the order of arrival.id. Repeated pairs are
  // counted once. Forces that pull are reversed. The grains that touch a wall without a side locate it. Each of these is
  // reported once for all frames in arrival.remarks. Throws SceneError like arrive().
  void take_contacts(const ForeignFrame &from, Arrival &arrival, const ForeignOptions &options, ArrivedFrame &to);

  // Fills arrival.checks, one per frame, and arrival.doubtful. Throws SceneError if walls are in the wrong order.
  void check_arrival(Arrival &arrival);
} // namespace diptych::coupling
