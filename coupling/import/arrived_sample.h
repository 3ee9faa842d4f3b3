// diptych: another code's sample in order, and what its check found
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
  // One instant: grains in ascending order of their ids, the same in all frames; bodies of contacts counted as in a Snapshot
  // (walls: lower, upper, left, right behind the grains). Forces and masses per unit thickness. NaN: not told.
  struct ArrivedFrame
  {
    std::string                          name;
    std::string                          grain_file, wall_file; // for messages
    double                               time = not_told;
    long                                 step = 0;
    std::vector<Eigen::Vector2d>         position, velocity, resultant;
    std::vector<double>                  radius, mass, rotation, spin;
    std::vector<discrete::ContactForce>  contacts; // that carry force
    std::vector<discrete::ContactStatus> status;
    bool                                 has_contacts = false;
    std::array<double, 4>                wall         = {not_told, not_told, not_told, not_told}; // places, as Side
    std::array<Eigen::Vector2d, 4>       wall_force;           // on the sample: of the contacts, else as a table tells it
    std::array<Eigen::Vector2d, 4>       told_wall_force;      // as a table tells it
    double                               upper_travel = 0;     // of the upper wall to the right since the first frame
    double                               overlap_miss = 0;     // largest difference of overlaps told from those of the discs
    double                               wall_miss    = 0;     // largest distance of a wall from its contact points
    double                               widest_gap   = 0;     // between two bodies that a contact joins
    bool                                 walls_touch  = false; // one is placed by the grains that reach farthest
    double                               point_miss   = 0;     // largest distance of a contact point told from where the two meet
  };

  // What the check of one frame found. Stresses are positive in compression.
  struct ArrivalCheck
  {
    std::string     name;
    double          time = not_told, axial_strain = not_told;
    int             grains = 0, contacts = 0; // between grains, that carry force
    int             lower_contacts = 0, upper_contacts = 0, left_contacts = 0, right_contacts = 0;
    double          mass = not_told, solid_fraction = not_told;
    bool            against_resultants = false;
    double          balance_rms = not_told, balance_worst = not_told;
    long            balance_worst_grain = 0;
    Eigen::Matrix2d contact_stress = Eigen::Matrix2d::Constant(not_told), wall_stress = contact_stress;
    double          stress_difference = not_told, wall_force_difference = not_told, largest_overlap = not_told;
  };

  template <class Check, class Visitor, std::enable_if_t<std::is_same_v<std::remove_const_t<Check>, ArrivalCheck>, int> = 0>
  void list_numbers(Check &c, Visitor &v)
  {
    v({"frame", "-", "what the files call it", Kind::setting}, c.name);
    v({"time", "time", "of the frame; null: not told"}, c.time);
    v({"axial_strain", "-", "descent of the upper wall / height in the first frame"}, c.axial_strain);
    v({"grains", "-", "grains"}, c.grains);
    v({"contacts", "-", "contacts of grains that carry force"}, c.contacts);
    v({"lower_contacts", "-", "contacts with the lower wall that carry force"}, c.lower_contacts);
    v({"upper_contacts", "-", "contacts with the upper wall that carry force"}, c.upper_contacts);
    v({"left_contacts", "-", "contacts with the left wall that carry force"}, c.left_contacts);
    v({"right_contacts", "-", "contacts with the right wall that carry force"}, c.right_contacts);
    v({"mass", "mass", "of all grains, per unit thickness"}, c.mass);
    v({"solid_fraction", "-", "area of the grains / area between the walls"}, c.solid_fraction);
    v({"balance_against_resultants", "-", "grains are held against the resultant that the file has of each; else against rest"},
      c.against_resultants);
    v({"balance_rms", "-",
       "rms over grains of the sum of contact forces minus resultant (or 0) / mean contact force; where no resultant is told and "
       "the "
       "sides are free, of its vertical component"},
      c.balance_rms);
    v({"balance_worst", "-", "largest of the same"}, c.balance_worst);
    v({"balance_worst_grain", "-", "id of that grain", Kind::setting}, c.balance_worst_grain);
    v({"contact_stress", "pressure", "sum over contacts of force (x) branch / area"}, c.contact_stress);
    v({"wall_stress", "pressure", "sum over wall contacts of force on the wall (x) contact point / area"}, c.wall_stress);
    v({"stress_difference", "-", "largest component of the difference of both / largest of the wall's: inertia, or an error"},
      c.stress_difference);
    v({"wall_force_difference", "-", "wall forces told beside the contacts against the sums of contacts, relative"},
      c.wall_force_difference);
    v({"largest_overlap", "mean diameters", "of two grains or of a grain and a wall"}, c.largest_overlap);
  }

  struct Arrival
  {
    std::string               format;
    std::vector<long>         id; // of the grains
    std::vector<ArrivedFrame> frames;
    std::vector<ArrivalCheck> checks;
    double                    thickness = 1, mean_diameter = not_told, density = not_told; // [mass / length^2 per unit thickness]
    std::vector<std::string>  remarks;  // what was taken in another way than it stood
    std::vector<std::string>  lacking;  // what the files do not hold: null, and left out of everything made of it
    std::vector<std::string>  doubtful; // what a check found and a user should look at
  };
} // namespace diptych::coupling
