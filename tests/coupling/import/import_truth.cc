// diptych: samples of six codes against numbers computed from the same files without this program
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>

#include <nlohmann/json.hpp>

#include "coupling/import/imported_results.h"
#include "tests/coupling/import/foreign_files.h"

namespace
{
  using namespace diptych::coupling;
  using namespace diptych::coupling::foreign_files;
  using nlohmann::json;

  // Numbers, or pairs [rows, rows with force].
  int wall_contacts(const json &frame)
  {
    for (const char *key :
         {"contacts_wall", "contact_rows_wall", "contacts_wall_with_force", "contacts_wall_rows_and_with_force"})
      if (const auto found = frame.find(key); found != frame.end())
        {
          if (found->is_number())
            return found->get<int>();
          int sum = 0;
          for (const auto &side : *found)
            sum += side.is_array() ? side.at(1).get<int>() : side.get<int>();
          return sum;
        }
    ADD_FAILURE() << "no wall contacts in the truth";
    return -1;
  }

  Eigen::Matrix2d in_compression(const json &tension)
  {
    Eigen::Matrix2d stress;
    for (const int a : {0, 1})
      for (const int b : {0, 1})
        stress(a, b) = -tension.at(std::size_t(a)).at(std::size_t(b)).get<double>();
    return stress;
  }

  void compare(const Case &c, const ArrivalCheck &check, const json &frame)
  {
    const auto contacts = frame.contains("contacts_grain_grain") ? frame.at("contacts_grain_grain")
                                                                 : frame.at("contacts_grain_grain_with_force");
    EXPECT_EQ(check.contacts, contacts.get<int>());
    EXPECT_EQ(check.lower_contacts + check.upper_contacts + check.left_contacts + check.right_contacts, wall_contacts(frame));
    EXPECT_EQ(check.grains, frame.value("grains", 400));
    const double mass = frame.at("mass").get<double>(); // the tables contain no masses
    EXPECT_TRUE(c.name == "csv" ? std::isnan(check.mass) : std::abs(check.mass - mass) < 1e-6 * mass) << check.mass;
    const Eigen::Matrix2d stress = in_compression(frame.at("mean_stress_from_contacts")),
                          walls  = in_compression(frame.at("mean_stress_from_wall_forces"));
    const double size            = stress.cwiseAbs().maxCoeff();
    EXPECT_LT((check.contact_stress - stress).cwiseAbs().maxCoeff(), c.stress_tolerance * size) << check.contact_stress << "\n"
                                                                                                << stress;
    // The files have fewer digits of the wall sums, or another moment of the step (0.02 % in LMGC90, see its README).
    EXPECT_LT((check.wall_stress - walls).cwiseAbs().maxCoeff(), 4e-4 * size) << check.wall_stress << "\n" << walls;
    EXPECT_NEAR(100 * check.stress_difference, frame.value("difference_contacts_walls_percent", 100 * check.stress_difference),
                0.05);
  }

  TEST(ImportTruth, CountsMassesAndStressesAreThoseOfTheFiles)
  {
    for (const Case &c : cases())
      {
        SCOPED_TRACE(c.name);
        const json    truth   = json::parse(text_of_file(path_of(c.truth + "/truth.json"))).at("frames");
        const Arrival arrival = arrival_of(c, options_of(c));
        ASSERT_EQ(arrival.checks.size(), truth.size());
        for (const ArrivalCheck &check : arrival.checks)
          for (const auto &[key, frame] : truth.items())
            if (check.name == key || check.name == "step " + key || check.name == "_" + key || check.name == "time " + key)
              {
                SCOPED_TRACE(key);
                compare(c, check, frame);
              }
        EXPECT_TRUE(arrival.doubtful.empty()) << arrival.doubtful.front();
      }
  }

  // Compares with the resultants that each code wrote, to nine digits. LIGGGHTS evaluates the law again after the velocities
  // have changed (2 % on moving plates).
  TEST(ImportTruth, ForcesOnEveryGrainAddUpToTheResultants)
  {
    for (const auto &[name, tolerance] : {std::pair("lammps", 1e-4), std::pair("liggghts", 0.03), std::pair("yade", 1e-6)})
      {
        const Case c = case_of(name);
        for (const ArrivalCheck &check : arrival_of(c, options_of(c)).checks)
          {
            EXPECT_TRUE(check.against_resultants);
            EXPECT_LT(check.balance_rms, tolerance) << name << " " << check.name;
          }
      }
  }

  // Spreadsheets and pandas write semicolons, carriage returns, a byte order mark, capitals, and an index without a name.
  TEST(ImportTruth, TablesOfSpreadsheetsAreTheSameTables)
  {
    const Case     c     = case_of("csv");
    const Arrival  plain = arrival_of(c, options_of(c));
    const Scratch  scratch;
    ForeignOptions options;
    for (const std::string &file : options_of(c).files)
      {
        std::istringstream in(text_of_file(file));
        std::string        text = "\xEF\xBB\xBF";
        int                row  = -1;
        for (std::string line; std::getline(in, line); ++row)
          {
            std::string changed = (row < 0 ? "" : std::to_string(row)) + "," + line + "\r\n";
            for (char &letter : changed)
              letter = letter == ',' ? ';' : row < 0 && letter == 'x' ? 'X' : letter;
            text += changed;
          }
        options.files.push_back(scratch.write(std::filesystem::path(file).filename().string(), text));
      }
    const Arrival changed = arrival_of(c, options);
    for (std::size_t k = 0; k < plain.checks.size(); ++k)
      EXPECT_EQ(changed.checks[k].contact_stress, plain.checks[k].contact_stress);
  }

  TEST(ImportTruth, TextAndHdf5OfOneRunAreOneSample)
  {
    const Arrival text    = arrival_of(case_of("lmgc90"), options_of(case_of("lmgc90"))),
                  hdf5    = arrival_of(case_of("lmgc90_hdf5"), options_of(case_of("lmgc90_hdf5")));
    const ArrivedFrame &a = text.frames[1], &b = hdf5.frames[2]; // OUT.3 and ID_3
    ASSERT_EQ(a.contacts.size(), b.contacts.size());
    for (std::size_t i = 0; i < a.position.size(); ++i)
      EXPECT_LT((a.position[i] - b.position[i]).norm(), 1e-9);
  }

  // The symmetrised internal moments of a snapshot add up to the mean stress of the check. All later results rest on them.
  TEST(ImportTruth, InternalMomentsSumUpToTheMeanStress)
  {
    for (const Case &c : cases())
      {
        SCOPED_TRACE(c.name);
        const Arrival         arrival = arrival_of(c, options_of(c));
        const DiscreteResults results = imported_results(arrival);
        for (std::size_t k = 0; k < results.snapshots.size(); ++k)
          {
            Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
            for (const Eigen::Matrix2d &moment : results.snapshots[k].internal_moment)
              sum += moment;
            const Eigen::Matrix2d stress = arrival.checks[k].contact_stress;
            EXPECT_LT((sum / results.snapshots[k].area - 0.5 * (stress + stress.transpose())).norm(), 1e-4 * stress.norm());
            EXPECT_NEAR(results.snapshots[k].axial_strain, arrival.checks[k].axial_strain, 1e-15);
          }
      }
  }

  TEST(ImportTruth, MissingNumbersAreNotInvented)
  {
    const Case            c       = case_of("csv");
    const DiscreteResults results = imported_results(arrival_of(c, options_of(c)));
    EXPECT_TRUE(std::isnan(results.snapshots[1].mass[0]));
    EXPECT_TRUE(std::isnan(results.snapshots[1].rotation[0]));
    EXPECT_TRUE(std::isnan(results.rows[1].time));
    EXPECT_TRUE(std::isnan(results.rows[1].kinetic_energy));
    EXPECT_TRUE(std::isnan(results.rows[1].friction_dissipation));
    EXPECT_TRUE(results.snapshots[1].window_dissipation.empty());
    EXPECT_EQ(results.snapshots[1].status[0], diptych::discrete::ContactStatus::unknown);
  }
} // namespace
