// diptych: truncated files and flipped bits are refused or cause a warning, or the result is nearly right
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <cstdlib>
#include <random>

#include "coupling/import/imported_results.h"
#include "tests/coupling/import/foreign_files.h"

namespace
{
  using namespace diptych::coupling;
  using namespace diptych::coupling::foreign_files;

  struct Outcome
  {
    bool refused = false, doubtful = false, near = false;
  };

  // `near`: the result agrees to 3 % of the stress, 0.1 % of the grains' area and one diameter in every position.
  Outcome outcome_of(const Case &c, const ForeignOptions &options, const Arrival &whole)
  {
    Outcome outcome;
    try
      {
        const Arrival         arrival = arrival_of(c, options);
        const DiscreteResults results = imported_results(arrival);
        outcome.doubtful              = !arrival.doubtful.empty();
        outcome.near                  = arrival.checks.size() == whole.checks.size();
        for (std::size_t k = 0; outcome.near && k < whole.checks.size(); ++k)
          {
            const ArrivalCheck &a = arrival.checks[k], &b = whole.checks[k];
            const double        stress = (a.contact_stress - b.contact_stress).norm() / b.contact_stress.norm();
            outcome.near &= a.grains == b.grains && (std::isnan(stress) || stress < 0.03) &&
                            std::abs(a.solid_fraction / b.solid_fraction - 1) < 1e-3;
            for (std::size_t i = 0; i < whole.frames[k].position.size(); ++i)
              outcome.near &= (arrival.frames[k].position[i] - whole.frames[k].position[i]).norm() < whole.mean_diameter;
          }
        for (const diptych::discrete::Snapshot &s : results.snapshots)
          for (const Eigen::Vector2d &x : s.position)
            EXPECT_TRUE(x.allFinite());
      }
    catch (const std::invalid_argument &error)
      {
        outcome.refused = true;
        EXPECT_NE(std::string(error.what()), "");
      }
    return outcome;
  }

  // Damages one of the case's files, chosen at random.
  ForeignOptions damaged(const Case                               &c,
                         const Scratch                            &scratch,
                         std::mt19937                             &random,
                         const std::function<void(std::string &)> &damage)
  {
    return with_changed(c, scratch, c.files[random() % c.files.size()], damage);
  }

  // 100, or the environment variable DIPTYCH_DRAWS.
  int n_draws()
  {
    const char *text = std::getenv("DIPTYCH_DRAWS");
    return text == nullptr ? 100 : std::stoi(text);
  }

  class ImportDamage : public testing::TestWithParam<std::string>
  {};

  // Complete lines may be missing at the end only if no count contradicts it. Then stresses or grains reveal the loss.
  TEST_P(ImportDamage, TruncatedFilesAreRefusedOrDoubtful)
  {
    const Case    c     = case_of(GetParam());
    const Arrival whole = arrival_of(c, options_of(c));
    std::mt19937  random(1);
    int           silent = 0, refused = 0;
    for (int k = 0; k < n_draws(); ++k)
      {
        const Scratch scratch;
        const Outcome outcome = outcome_of(
          c, damaged(c, scratch, random, [&](std::string &text) { text.resize(random() % text.size()); }), whole);
        refused += outcome.refused;
        silent += !outcome.refused && !outcome.doubtful && !outcome.near;
      }
    EXPECT_EQ(silent, 0);
    EXPECT_GE(refused, 0.85 * n_draws());
  }

  TEST_P(ImportDamage, AFlippedBitIsRefusedDoubtfulOrSmall)
  {
    const Case    c     = case_of(GetParam());
    const Arrival whole = arrival_of(c, options_of(c));
    std::mt19937  random(2);
    int           silent = 0;
    for (int k = 0; k < n_draws(); ++k)
      {
        const Scratch  scratch;
        std::string    what;
        ForeignOptions options = damaged(c, scratch, random, [&](std::string &text) {
          const std::size_t at = random() % text.size();
          text[at]             = char(text[at] ^ (1 << random() % 8));
          what                 = "byte " + std::to_string(at) + ": " + text.substr(at < 40 ? 0 : at - 40, 80);
        });
        const Outcome  outcome = outcome_of(c, options, whole);
        silent += !outcome.refused && !outcome.doubtful && !outcome.near;
        EXPECT_TRUE(outcome.refused || outcome.doubtful || outcome.near) << what;
      }
    EXPECT_EQ(silent, 0);
  }

  INSTANTIATE_TEST_SUITE_P(Formats,
                           ImportDamage,
                           testing::Values("lammps", "liggghts", "yade", "lmgc90", "lmgc90_hdf5", "mercurydpm", "csv"),
                           [](const auto &info) { return info.param; });

  // Nothing within one frame contradicts these changes: forces and positions are right, and the area of a stress is that
  // between the walls.
  TEST(ImportDoubts, AFrameThatIsUnlikeTheOneBeforeIsDoubtful)
  {
    const Case    c = case_of("csv");
    const Scratch scratch;
    EXPECT_FALSE(holds(arrival_of(c, options_of(c)).doubtful, "in the frame before"));
    const Arrival wide = arrival_of(c, with_changed(c, scratch, "plain_csv/walls.csv", [](std::string &text) {
                                      replace_once(text, "1,0.0317409221,", "1,0.2317409221,");
                                    }));
    EXPECT_TRUE(holds(wide.doubtful, "frame 1: the solid fraction between the walls is 0.11"));
    const Arrival small = arrival_of(c, with_changed(c, scratch, "plain_csv/particles_1.csv", [](std::string &text) {
                                       replace_once(text, "0.00077969925", "0.00077069925");
                                     }));
    EXPECT_TRUE(holds(small.doubtful, "frame 1: the radius of grain 1 is 0.000770699 instead of 0.000779699"));
  }

  TEST(ImportDoubts, WrongAndLostContactsAreDetected)
  {
    const Case c        = case_of("csv");
    const auto doubtful = [&](const std::function<void(std::string &)> &change) {
      const Scratch scratch;
      return arrival_of(c, with_changed(c, scratch, "plain_csv/contacts_1.csv", change)).doubtful;
    };
    EXPECT_TRUE(holds(doubtful([](std::string &text) { replace_once(text, "69,49,", "69,50,"); }), "do not touch"));
    EXPECT_TRUE(holds(doubtful([](std::string &text) { replace_once(text, "161,154,-14.748704,-21.2551418", "161,154,0,0"); }),
                      "is far from balance"));
    EXPECT_TRUE(
      holds(doubtful([](std::string &text) { text.resize(text.find("434,15,")); }), "too few contacts to hold the grains"));
  }

  TEST(ImportDoubts, AContactPointOffTheSurfaceIsDetected)
  {
    const Case    c = case_of("liggghts");
    const Scratch scratch;
    EXPECT_TRUE(
      holds(arrival_of(c, with_changed(c, scratch, "liggghts/wallcontacts_100000.dump",
                                       [](std::string &text) { replace_once(text, "\n0 0.0257691629 0", "\n0 0.0457691629 0"); }))
              .doubtful,
            "off the place where the surfaces meet"));
  }

  TEST(ImportDoubts, VectorsOtherThanUnitNormalsAreRefused)
  {
    const auto refused = [](const char *name, const char *file, const std::function<void(std::string &)> &change) {
      const Case    c = case_of(name);
      const Scratch scratch;
      EXPECT_NE(refusal_of(c, with_changed(c, scratch, file, change)).find("not a unit normal"), std::string::npos) << name;
    };
    refused("lmgc90", "lmgc90/OUTBOX/Vloc_Rloc.OUT.1", [](std::string &text) { replace_once(text, "n(1)=-0.5", "n(1)=-0.9"); });
    refused("lmgc90_hdf5", "lmgc90_hdf5/lmgc90.h5", [](std::string &text) { text[338503] = char(text[338503] ^ 1); });
    refused("mercurydpm", "mercurydpm/Biaxial2D.fstat",
            [](std::string &text) { replace_once(text, " 0.7865765336 -0.617492799 ", " 0.1865765336 -0.617492799 "); });
  }

  // No row with text is skipped, and a head with exchanged columns is not accepted.
  TEST(ImportDoubts, ContradictoryTablesAreRefused)
  {
    const auto expect = [](const char *file, const std::string &what, const std::function<void(std::string &)> &change) {
      const Case        c = case_of("csv");
      const Scratch     scratch;
      const std::string refusal = refusal_of(c, with_changed(c, scratch, std::string("plain_csv/") + file, change));
      EXPECT_NE(refusal.find(what), std::string::npos) << refusal;
      EXPECT_NE(refusal.find(file), std::string::npos) << refusal;
    };
    const auto after_line = [](const std::string &line) {
      return [line](std::string &text) { text.insert(text.find("\n434,15") + 1, line + "\n"); };
    };
    for (const char *row : {"NaN,NaN,NaN,NaN", "NA,NA,NA,NA", "j,i,fx,fy"})
      expect("contacts_1.csv", "text among rows of numbers", after_line(row));
    expect("walls.csv", "line 5: frame 1 has another width in line 3", [](std::string &text) { text += "1,0.03,0.05\n"; });
    expect("particles_1.csv", "contradict each other",
           [](std::string &text) { replace_once(text, "id,x,y,r,vx", "id,x,y,r,d"); });
    const Case    c = case_of("csv");
    const Scratch scratch;
    const auto    same = with_changed(c, scratch, "plain_csv/contacts_1.csv", after_line("i,j,fx,fy\n# a remark in words"));
    EXPECT_EQ(arrival_of(c, same).checks[1].contacts, arrival_of(c, options_of(c)).checks[1].contacts);
    const auto time = with_changed(c, scratch, "plain_csv/walls.csv", [](std::string &text) {
      text = "frame,width,height,time\n0,0.03145263837,0.05022203151,5\n1,0.0317409221,0.04971981119,4\n2,0.032,0.0492,6\n";
    });
    EXPECT_NE(refusal_of(c, time).find("frame 1 has the time 4, but frame 0 before it has 5"), std::string::npos)
      << refusal_of(c, time);
  }

  // A table places the walls, in one file or several. Messages name the line of the frame.
  TEST(ImportDoubts, ImpossibleWallsAreReportedWithTheLineOfTheirTable)
  {
    const Case    c = case_of("csv");
    const Scratch scratch;
    const auto    expect = [&](const std::string &what, const std::function<void(std::string &)> &change) {
      const ForeignOptions options = with_changed(c, scratch, "plain_csv/walls.csv", change);
      try
        {
          (void)imported_results(arrival_of(c, options));
          ADD_FAILURE() << what;
        }
      catch (const SceneError &error)
        {
          EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
        }
    };
    expect("walls.csv, line 3: frame 1: the lower and the upper wall are",
           [](std::string &text) { replace_once(text, "0.04971981119", "1e300"); });
    expect("walls.csv, line 4: frame 2: the lower wall lies beyond the upper one", [](std::string &text) {
      text = "frame,left_x,right_x,lower_y,upper_y\n0,0,0.03145,0,0.0502\n1,0,0.0317,0,0.0497\n2,0,0.0329,0.1,0.0487\n";
    });

    ForeignOptions several = with_changed(c, scratch, "plain_csv/walls.csv",
                                          [](std::string &text) { text.resize(text.find("\n2,") + 1); });
    several.files.push_back(scratch.write("last.csv", "frame,width,height\n2,0.03289052612,0.04871537056\n"));
    const Arrival apart = arrival_of(c, several), whole = arrival_of(c, options_of(c));
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(apart.frames[k].wall, whole.frames[k].wall);
    several.files.back() = scratch.write("last.csv", "frame,width,height\n2,-1,0.04871537056\n");
    EXPECT_NE(refusal_of(c, several).find("last.csv, line 2"), std::string::npos) << refusal_of(c, several);
    several.files.back() = scratch.write("last.csv", "frame,width,height\n2,0.03,0.0487\n1,0.03,0.0487\n");
    EXPECT_NE(refusal_of(c, several).find("last.csv, line 3: frame 1 has another width in line 3 of "), std::string::npos)
      << refusal_of(c, several);
  }

  ForeignSample row_of_grains(const int n, const double spacing, const double radius_of_the_first)
  {
    ForeignSample sample;
    sample.format = "csv";
    ForeignFrame frame;
    frame.name = "0";
    for (int i = 0; i < n; ++i)
      {
        ForeignGrain g;
        g.id = i, g.position = {spacing * i, 0}, g.radius = i == 0 ? radius_of_the_first : 0.5;
        frame.grains.push_back(g);
      }
    for (const auto &[side, place] :
         {std::pair(Side::lower, -1e3), std::pair(Side::upper, 1e3), std::pair(Side::left, -1e3), std::pair(Side::right, 1e6)})
      {
        ForeignWall wall;
        wall.side = side, wall.place = place;
        frame.walls.push_back(wall);
      }
    sample.frames.push_back(frame);
    return sample;
  }

  // The large grain finds its overlap with the farthest small one that it reaches.
  TEST(ImportDoubts, OverlapsOfAnySizesAreFoundAndCrowdsRefused)
  {
    ForeignOptions options;
    options.mean_diameter = 1;
    EXPECT_NEAR(arrive(row_of_grains(1000, 1, 0.5), options).checks[0].largest_overlap, 0, 1e-12);
    EXPECT_NEAR(arrive(row_of_grains(1000, 1, 300), options).checks[0].largest_overlap, 299.5, 1e-9); // with its neighbour
    ForeignSample touching = row_of_grains(3, 100.4, 100); // only the large one's reach includes the small one
    EXPECT_NEAR(arrive(touching, options).checks[0].largest_overlap, 0.1, 1e-9);
    EXPECT_THROW((void)arrive(row_of_grains(1000, 1e-3, 0.5), options), SceneError);
  }
} // namespace
