// diptych: peculiarities of other codes' files that a reader must handle
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>

#include "coupling/import/imported_results.h"
#include "tests/coupling/import/foreign_files.h"

namespace
{
  using namespace diptych::coupling;
  using namespace diptych::coupling::foreign_files;

  Eigen::Matrix2d stress_of(const Case &c, const ForeignOptions &options, const std::size_t frame)
  {
    return arrival_of(c, options).checks.at(frame).contact_stress;
  }

  void expect_same_stress(const Case &c, const ForeignOptions &options, const double tolerance = 1e-9)
  {
    const Arrival changed = arrival_of(c, options), plain = arrival_of(c, options_of(c));
    for (std::size_t k = 0; k < plain.checks.size(); ++k)
      {
        EXPECT_EQ(changed.checks[k].contacts, plain.checks[k].contacts);
        EXPECT_LT((changed.checks[k].contact_stress - plain.checks[k].contact_stress).norm(),
                  tolerance * plain.checks[k].contact_stress.norm());
      }
  }

  // Changes a text line by line.
  void change_lines(std::string &text, const std::function<std::string(const std::string &, int)> &change)
  {
    std::istringstream in(text);
    std::string        out;
    int                number = 0;
    for (std::string line; std::getline(in, line);)
      out += change(line, number++);
    text = out;
  }

  std::string negated(const std::string &number)
  {
    return number[0] == '-' ? number.substr(1) : "-" + number;
  }

  // fx, fy of compute pair/local are the normal force only. Without p1, p2 the stress at 1 % differs.
  TEST(ImportTraps, LammpsForceWithoutTangentialPartIsReported)
  {
    const Case     c       = case_of("lammps");
    ForeignOptions options = options_of(c);
    options.columns        = {"contacts=index,patom1,patom2,dist,force,fx,fy,-,-,-"};
    const Arrival arrival  = arrival_of(c, options);
    EXPECT_TRUE(holds(arrival.lacking, "tangential forces"));
    EXPECT_GT(std::abs(arrival.checks[1].contact_stress(0, 0) / stress_of(c, options_of(c), 1)(0, 0) - 1), 0.05);
    EXPECT_TRUE(holds(arrival.doubtful, "resultant"));
  }

  TEST(ImportTraps, LammpsColumnsOfAnotherMeaningAreRefused)
  {
    const Case     c       = case_of("lammps");
    ForeignOptions options = options_of(c);
    options.columns        = {"contacts=index,patom1,patom2,force,dist,fx,fy,p1,p2,p4"};
    EXPECT_NE(refusal_of(c, options).find("contacts.dump, line 10"), std::string::npos) << refusal_of(c, options);
    options.columns = {"contacts=index,patom1"};
    EXPECT_NE(refusal_of(c, options).find("10 columns, not 2"), std::string::npos) << refusal_of(c, options);
  }

  TEST(ImportTraps, LammpsFramesThatDoNotMatchAreRefused)
  {
    const Case    c = case_of("lammps");
    const Scratch scratch;
    EXPECT_NE(refusal_of(c, with_changed(
                              c, scratch, "lammps/contacts.dump",
                              [](std::string &text) { replace_once(text, "ITEM: TIMESTEP\n240000", "ITEM: TIMESTEP\n240001"); }))
                .find("the frames do not match"),
              std::string::npos);
  }

  TEST(ImportTraps, LammpsRowsAreCountedAgainstTheHead)
  {
    const Case    c = case_of("lammps");
    const Scratch scratch;
    EXPECT_NE(refusal_of(c, with_changed(c, scratch, "lammps/contacts.dump",
                                         [](std::string &text) { replace_once(text, "ENTRIES\n731", "ENTRIES\n732"); }))
                .find("has 731 rows instead of 732"),
              std::string::npos);
  }

  TEST(ImportTraps, LammpsPeriodicBoxIsRefused)
  {
    const Case    c = case_of("lammps");
    const Scratch scratch;
    EXPECT_NE(refusal_of(c, with_changed(c, scratch, "lammps/grains.dump",
                                         [](std::string &text) { replace_once(text, "BOX BOUNDS ff", "BOX BOUNDS pp"); }))
                .find("periodic along x"),
              std::string::npos);
  }

  // Without a table, the contact points give the places of the walls.
  TEST(ImportTraps, LammpsWallsAreFoundWithoutATable)
  {
    const Case     c       = case_of("lammps");
    ForeignOptions options = options_of(c);
    options.files.pop_back();
    expect_same_stress(c, options, 1e-5);
  }

  // Densities of a data file are those of spheres in any dimension.
  TEST(ImportTraps, LammpsDataFileHasNoMassesOfDiscs)
  {
    const Scratch  scratch;
    ForeignOptions options;
    options.files         = {scratch.write(
              "start.data", "LAMMPS data file\n\n3 atoms\n1 atom types\n\n0 1 xlo xhi\n0 1 ylo yhi\n-1 1 zlo zhi\n\nAtoms # sphere\n\n"
                                    "1 1 0.2 1e6 0.1 0.1 0\n2 1 0.2 1e6 0.3 0.1 0\n3 1 0.2 1e6 0.2 0.273 0\n")};
    options.walls_touch   = true;
    const Arrival arrival = arrive(read_lammps(options), options);
    EXPECT_TRUE(std::isnan(arrival.frames[0].mass[0]));
    EXPECT_TRUE(holds(arrival.lacking, "masses"));
    EXPECT_DOUBLE_EQ(arrival.mean_diameter, 0.2);
  }

  TEST(ImportTraps, GapsInIdsAreReported)
  {
    const Case    c       = case_of("lammps");
    const Arrival arrival = arrival_of(c, options_of(c));
    EXPECT_TRUE(holds(arrival.remarks, "ids run from 1 to 479 with 79 missing"));
    EXPECT_EQ(arrival.id.size(), 400u);
  }

  TEST(ImportTraps, SpheresNeedAThickness)
  {
    for (const char *name : {"liggghts", "yade"})
      {
        const Case     c       = case_of(name);
        ForeignOptions options = options_of(c);
        options.thickness.reset();
        EXPECT_NE(refusal_of(c, options).find("--thickness"), std::string::npos) << name;
        options.thickness = 2;
        EXPECT_LT((2 * stress_of(c, options, 1) - stress_of(c, options_of(c), 1)).norm(), 1e-9 * stress_of(c, options, 1).norm());
      }
  }

  // The keyword contactPoint is 0 for plates. Without STL and table, `pos` gives their places.
  TEST(ImportTraps, LiggghtsPlatesAreFoundFromTheirContacts)
  {
    const Case     c       = case_of("liggghts");
    ForeignOptions options = options_of(c);
    const auto     is_stl  = [](const std::string &file) { return std::filesystem::path(file).extension() == ".stl"; };
    options.files.erase(std::remove_if(options.files.begin(), options.files.end(), is_stl), options.files.end());
    expect_same_stress(c, options, 1e-5);
  }

  // walls.txt of this run contains forces on the plates; the wall contacts contain forces on the grains.
  TEST(ImportTraps, LiggghtsForcesOnPlatesAreReversed)
  {
    const Case     c       = case_of("liggghts");
    ForeignOptions options = options_of(c);
    options.files.push_back(path_of("liggghts/walls.txt"));
    const Arrival arrival = arrival_of(c, options);
    EXPECT_TRUE(holds(arrival.remarks, "wall forces in the files act on the walls"));
    for (const ArrivalCheck &check : arrival.checks)
      EXPECT_LT(check.wall_force_difference, 0.01);
  }

  TEST(ImportTraps, LiggghtsKeywordsInAnotherOrderAreRefused)
  {
    const Case     c       = case_of("liggghts");
    ForeignOptions options = options_of(c);
    options.columns        = {"contacts=force,pos,id,force_normal,force_tangential,contactArea,delta,contactPoint"};
    EXPECT_FALSE(refusal_of(c, options).empty());
    options.columns = {"contacts=pos,id,force"};
    EXPECT_NE(refusal_of(c, options).find("--columns contacts="), std::string::npos);
  }

  // Bodies other than spheres are walls, whatever their ids. The grains that touch them show their sides.
  TEST(ImportTraps, YadeWallsAreFoundWithoutTheirFile)
  {
    const Case     c       = case_of("yade");
    ForeignOptions options = options_of(c);
    const auto     is_wall = [](const std::string &file) { return file.find("walls_") != std::string::npos; };
    options.files.erase(std::remove_if(options.files.begin(), options.files.end(), is_wall), options.files.end());
    expect_same_stress(c, options, 1e-5);
  }

  TEST(ImportTraps, YadeExportWithoutIdsIsRefusedWithContacts)
  {
    ForeignOptions options;
    options.files     = {path_of("yade/xyzr_0.txt"), path_of("yade/contacts_0.txt")};
    options.thickness = 1;
    EXPECT_THROW((void)read_yade(options), SceneError);
  }

  // VTKRecorder omits wall contacts and the direction of tangential forces: 600 of 651 contacts, normal parts only.
  TEST(ImportTraps, YadeRecorderLosesTangentialForcesAndWalls)
  {
    ForeignOptions options;
    options.thickness   = 1;
    options.walls_touch = true;
    for (const char *number : {"70000", "92149", "114298", "136447"})
      for (const char *kind : {"rec-spheres.", "rec-intrs."})
        options.files.push_back(path_of(std::string("yade/") + kind + number + (kind[4] == 's' ? ".vtu" : ".vtp")));
    const Arrival arrival = arrive(read_yade(options), options);
    EXPECT_TRUE(holds(arrival.lacking, "tangential forces"));
    EXPECT_TRUE(holds(arrival.lacking, "contacts with walls"));
    EXPECT_EQ(arrival.checks.back().contacts, 600);
    ForeignOptions ascii = options;
    ascii.files          = {path_of("yade/rec-ascii-spheres.136447.vtu"), path_of("yade/rec-ascii-intrs.136447.vtp")};
    const Arrival same   = arrive(read_yade(ascii), ascii);
    ASSERT_EQ(same.frames[0].contacts.size(), arrival.frames.back().contacts.size());
    for (std::size_t k = 0; k < same.frames[0].contacts.size(); ++k)
      EXPECT_LT((same.frames[0].contacts[k].force - arrival.frames.back().contacts[k].force).norm(), 1e-6);
  }

  // X(3) = pi/2 is the orientation of a side wall and not a motion.
  TEST(ImportTraps, Lmgc90SideWallsDoNotTravel)
  {
    const Case    c       = case_of("lmgc90");
    const Arrival arrival = arrival_of(c, options_of(c));
    for (const ArrivedFrame &frame : arrival.frames)
      EXPECT_EQ(frame.upper_travel, 0);
    EXPECT_NEAR(arrival.frames[0].wall[int(Side::right)] - arrival.frames[0].wall[int(Side::left)], 0.031845922, 1e-8);
  }

  TEST(ImportTraps, Lmgc90FilesOfTwoStepsAreRefused)
  {
    const Case    c = case_of("lmgc90");
    const Scratch scratch;
    EXPECT_NE(refusal_of(c, with_changed(c, scratch, "lmgc90/OUTBOX/Vloc_Rloc.OUT.1",
                                         [](std::string &text) { replace_once(text, "$steps      220", "$steps      221"); }))
                .find("do not match"),
              std::string::npos);
  }

  TEST(ImportTraps, Lmgc90NeedsItsBodies)
  {
    const Case     c       = case_of("lmgc90_hdf5");
    ForeignOptions options = options_of(c);
    options.files.erase(options.files.begin());
    EXPECT_NE(refusal_of(c, options).find("BODIES.DAT is missing"), std::string::npos);
  }

  TEST(ImportTraps, MercuryContactsThatOccurOnceShowATruncatedFile)
  {
    const Case    c = case_of("mercurydpm");
    const Scratch scratch;
    const auto    without_last = [](std::string &text) { text.erase(text.rfind('\n', text.size() - 2) + 1); };
    EXPECT_NE(refusal_of(c, with_changed(c, scratch, "mercurydpm/Biaxial2D.fstat", without_last)), "");
  }

  // A contact with a grain of infinite mass occurs once, written for the free grain.
  TEST(ImportTraps, MercuryContactsWithFixedGrainsOccurOnce)
  {
    const Case     c = case_of("mercurydpm");
    const Scratch  scratch;
    ForeignOptions options = with_changed(c, scratch, "mercurydpm/Biaxial2D.fstat", [](std::string &text) {
      change_lines(text, [](const std::string &line, int) {
        std::istringstream words(line);
        std::string        time, i, j;
        words >> time >> i >> j;
        return i == "200" && time != "#" && j[0] != '-' ? "" : line + "\n"; // rows of the fixed grain 200
      });
    });
    options.files.erase(std::find(options.files.begin(), options.files.end(), path_of("mercurydpm/Biaxial2D.ene")));
    EXPECT_NE(refusal_of(c, options).find("occurs 1 times"), std::string::npos) << refusal_of(c, options);
    for (std::string &file : options.files)
      if (file == path_of("mercurydpm/Biaxial2D.restart.4"))
        {
          std::string text = text_of_file(file);
          replace_once(text, "invMass 73.6294939049628", "invMass 0");
          file = scratch.write("Biaxial2D.restart.4", text);
        }
    expect_same_stress(c, options);
  }

  TEST(ImportTraps, MercuryWithoutRestartHasNoMasses)
  {
    const Case     c       = case_of("mercurydpm");
    ForeignOptions options = options_of(c);
    options.files.pop_back();
    const Arrival arrival = arrival_of(c, options);
    EXPECT_TRUE(holds(arrival.lacking, "masses"));
    EXPECT_TRUE(std::isnan(arrival.checks[0].mass));
  }

  TEST(ImportTraps, MercurySpheresInThePlaneNeedAThickness)
  {
    const Case     c = case_of("mercurydpm");
    const Scratch  scratch;
    ForeignOptions options = with_changed(c, scratch, "mercurydpm/Biaxial2D.restart.4", [](std::string &text) {
      replace_once(text, "particleDimensions 2", "particleDimensions 3");
    });
    EXPECT_NE(refusal_of(c, options).find("--thickness"), std::string::npos);
  }

  std::string with_force_negated(const std::string &line, const bool walls)
  {
    std::vector<std::string> field;
    std::istringstream       in(line);
    for (std::string word; std::getline(in, word, ',');)
      field.push_back(word);
    if ((field[1][0] == '-') == walls)
      field[2] = negated(field[2]), field[3] = negated(field[3]);
    return field[0] + "," + field[1] + "," + field[2] + "," + field[3] + "\n";
  }

  // The forces act on j, or on the wall. With one kind of contact reversed, balance fails; with all reversed it holds. The
  // condition that contacts push detects both.
  TEST(ImportTraps, TablesWithForcesOnTheOtherBodyAreReversed)
  {
    const Case    c = case_of("csv");
    const Scratch scratch;
    for (const bool walls : {false, true})
      {
        const ForeignOptions options = with_changed(c, scratch, "plain_csv/contacts_1.csv", [&](std::string &text) {
          change_lines(
            text, [&](const std::string &line, const int k) { return k == 0 ? line + "\n" : with_force_negated(line, walls); });
        });
        expect_same_stress(c, options);
        EXPECT_TRUE(holds(arrival_of(c, options).remarks,
                          walls ? "forces of walls on grains were reversed" : "forces between grains were reversed"));
      }
  }

  TEST(ImportTraps, TablesWithEveryPairTwiceCountItOnce)
  {
    const Case           c = case_of("csv");
    const Scratch        scratch;
    const ForeignOptions options = with_changed(c, scratch, "plain_csv/contacts_1.csv", [](std::string &text) {
      change_lines(text, [](const std::string &line, const int k) {
        std::vector<std::string> field;
        std::istringstream       in(line);
        for (std::string word; std::getline(in, word, ',');)
          field.push_back(word);
        const bool pair = k > 0 && field[1][0] != '-';
        return line + "\n" + (pair ? field[1] + "," + field[0] + "," + negated(field[2]) + "," + negated(field[3]) + "\n" : "");
      });
    });
    expect_same_stress(c, options);
    EXPECT_TRUE(holds(arrival_of(c, options).remarks, "two rows"));
  }

  TEST(ImportTraps, TablesWithTwoForcesForOnePairAreRefused)
  {
    const Case    c = case_of("csv");
    const Scratch scratch;
    EXPECT_NE(
      refusal_of(c, with_changed(c, scratch, "plain_csv/contacts_1.csv", [](std::string &text) { text += "49,69,1,1\n"; }))
        .find("twice with different forces"),
      std::string::npos);
  }

  TEST(ImportTraps, ContactsOfUnknownBodiesAndRepeatedGrainsAreRefused)
  {
    const Case        c = case_of("csv");
    const Scratch     scratch;
    const std::string nobody = refusal_of(
      c, with_changed(c, scratch, "plain_csv/contacts_1.csv", [](std::string &text) { replace_once(text, "69,49,", "69,4,"); }));
    EXPECT_NE(nobody.find("contacts_1.csv, line 3"), std::string::npos) << nobody;
    EXPECT_NE(nobody.find("body 4, which is not a grain"), std::string::npos) << nobody;
    EXPECT_NE(refusal_of(c, with_changed(c, scratch, "plain_csv/particles_1.csv",
                                         [](std::string &text) { replace_once(text, "\n2,", "\n1,"); }))
                .find("grain 1 occurs twice"),
              std::string::npos);
    EXPECT_NE(refusal_of(c, with_changed(c, scratch, "plain_csv/particles_1.csv",
                                         [](std::string &text) {
                                           change_lines(text, [](const std::string &line, const int k) {
                                             return k == 5 ? "" : line + "\n";
                                           });
                                         }))
                .find("lacks grain"),
              std::string::npos);
  }

  // Without wall places in the tables, the import asks for them, or uses the outermost grains, which is right to within an
  // overlap.
  TEST(ImportTraps, TablesWithoutWallsNeedAnOption)
  {
    const Case     c       = case_of("csv");
    ForeignOptions options = options_of(c);
    options.files.pop_back();
    EXPECT_NE(refusal_of(c, options).find("--walls-touch"), std::string::npos);
    options.walls_touch = true;
    const double d      = arrival_of(c, options).mean_diameter;
    for (const int side : {0, 1, 2, 3})
      EXPECT_LT(std::abs(arrival_of(c, options).frames[1].wall[std::size_t(side)] -
                         arrival_of(c, options_of(c)).frames[1].wall[std::size_t(side)]),
                0.02 * d);
  }
} // namespace
