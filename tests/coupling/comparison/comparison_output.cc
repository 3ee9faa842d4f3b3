// diptych: tests that every written number and array is described, and every described one is written
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <sstream>

#include <nlohmann/json.hpp>

#include "coupling/comparison/comparison_arrays.h"
#include "coupling/comparison/comparison_output.h"
#include "coupling/comparison/comparison_schema.h"
#include "coupling/numbers/number_json.h"
#include "discrete/files/hdf5_file.h"
#include "tests/coupling/comparison/example_results.h"
#include "tests/coupling/store/examples.h"

namespace
{
  using namespace diptych::coupling::synthetic;
  using nlohmann::json;

  struct Written
  {
    files::Folder folder;
    json          document;
    std::string   csv;

    Written()
    {
      const Results    results = example_results();
      const Comparison c       = compare(example_scene(), results);
      write_comparison(folder.path, {example_scene(), c});
      write_comparison_h5(folder.path, {example_scene(), c}, results);
      std::ifstream(folder / "comparison.json") >> document;
      csv = files::read_text(folder / "comparison.csv");
    }
  };

  const Written &written()
  {
    static const Written w;
    return w;
  }

  // Places of all leaves. The entries of a list are below the list's key.
  void collect(const json &value, const std::string &place, std::set<std::string> &places)
  {
    if (value.is_object() && !(value.contains("value") && value.contains("low")))
      for (const auto &[key, part] : value.items())
        collect(part, place.empty() ? key : place + "/" + key, places);
    else if (value.is_array() && !value.empty() && value[0].is_object())
      for (const json &part : value)
        collect(part, place, places);
    else
      places.insert(place);
  }

  TEST(ComparisonOutput, EveryNumberIsDescribedOnce)
  {
    std::set<std::string> described, places;
    for (const NumberDescription &number : comparison_schema())
      {
        EXPECT_TRUE(described.insert(number.place).second) << number.place << " twice";
        EXPECT_FALSE(number.meaning.empty()) << number.place;
        if (number.shape != "group" && number.shape != "list of groups")
          {
            EXPECT_FALSE(number.unit.empty()) << number.place;
          }
      }
    json document = written().document;
    document.erase("numbers");
    collect(document, "", places);
    EXPECT_GT(places.size(), 150u);
    for (const std::string &place : places)
      EXPECT_EQ(described.count(place), 1u) << place;
  }

  TEST(ComparisonOutput, FileHasTheDescriptionsOfItsNumbers)
  {
    const json &angle = written().document["numbers"]["windows/discrete/bands/angle_deg"];
    EXPECT_EQ(angle["unit"], "degrees");
    EXPECT_EQ(angle["kind"], "line");
    EXPECT_EQ(angle["shape"], "number with its 95 % interval");
    EXPECT_EQ(written().document["numbers"].size(), comparison_schema().size());
    EXPECT_EQ(written().document["format"], 2);
    EXPECT_EQ(written().document["walk"], "axial_strain");
  }

  TEST(ComparisonOutput, UnknownNumbersAreNullAndLengthsAreInDiameters)
  {
    const json &window = written().document["windows"][0];
    EXPECT_NEAR(window["discrete"]["bands"][0]["half_width_d"]["value"].get<double>(), 3, 0.01);
    EXPECT_TRUE(window["discrete"]["bands"][0]["half_width_d"]["low"].is_null()); // no resamples were drawn
    EXPECT_TRUE(written().document["discrete_summary"]["grain_stress_error"].is_null());

    json          out = json::object();
    NumbersToJson writer{out, 2}; // the mean diameter is 2
    writer({"size_d", "mean diameters", "a length", Kind::number, true}, 3.);
    writer({"plain", "length", "a length"}, 3.);
    writer({"unknown", "-", "nothing"}, std::nan(""));
    EXPECT_EQ(out, json::parse(R"({"size_d": 1.5, "plain": 3.0, "unknown": null})"));
  }

  // Columns: from, to, panel, quantity, value, low, high, unit.
  TEST(ComparisonOutput, EveryLineOfTheTableHasItsUnit)
  {
    std::istringstream in(written().csv);
    std::string        line;
    bool               found = false;
    std::getline(in, line);
    EXPECT_EQ(line, "progress_from,progress_to,panel,quantity,value,low,high,unit");
    while (std::getline(in, line))
      if (line.rfind("0.0,0.02,continuum,bands/1/angle_deg,-4", 0) == 0)
        {
          found = true;
          EXPECT_EQ(line.substr(line.rfind(',') + 1), "degrees");
        }
    EXPECT_TRUE(found);
  }

  // Steps of the panels reach a stage to within rounding errors; the table names the stage, comparison.json what was reached.
  TEST(ComparisonOutput, TheTableNamesTheStageThatTheSceneAskedFor)
  {
    const files::Folder folder;
    Comparison          c = compare(example_scene(), example_results());
    c.windows[0].to       = 0.0199999999998;
    write_comparison(folder.path, {example_scene(), c});
    json document;
    std::ifstream(folder / "comparison.json") >> document;
    EXPECT_EQ(document["windows"][0]["to"], 0.0199999999998);
    const std::string csv = files::read_text(folder / "comparison.csv");
    EXPECT_NE(csv.find("\n0.0,0.02,continuum,"), std::string::npos);
    EXPECT_EQ(csv.find("0.0199999999998"), std::string::npos);
  }

  TEST(ComparisonOutput, ArraysHaveTitleUnitAndMeaning)
  {
    const diptych::discrete::Hdf5Reader file(written().folder / "comparison.h5");
    const std::string                   name = "stage_0002/cells/discrete_mean_stress";
    EXPECT_EQ(file.text_attribute(name, "unit"), "pressure");
    EXPECT_EQ(file.text_attribute(name, "title"), "mean stress s");
    EXPECT_FALSE(file.text_attribute(name, "meaning").empty());
    EXPECT_EQ(file.read(name).size(), 20u * 28);
    EXPECT_EQ(file.extents("stage_0002/cells/nodes"), (std::vector<std::size_t>{20 * 28, 4}));
    EXPECT_NEAR(file.attribute("window_0", "displacement_unit"), 1.12e-6 * std::sqrt(2.), 1e-18);
    EXPECT_EQ(file.text_attribute("/", "walk"), "axial_strain");
  }

  // s = 1.5 and t = 0.5 at 45 degrees. For an unsymmetric stress only the symmetric part counts.
  TEST(ComparisonOutput, PrincipalStressesOfKnownTensors)
  {
    Eigen::Matrix2d plain, skew, tension;
    plain << 1.5, 0.5, 0.5, 1.5;
    skew << 1.5, 0.8, 0.2, 1.5;
    tension << -1, 0, 0, -2;
    const std::vector<Eigen::Matrix2d> stress = {plain, skew, tension};
    for (const int k : {0, 1})
      {
        EXPECT_DOUBLE_EQ(arrays::mean_stress(stress)[k], 1.5);
        EXPECT_DOUBLE_EQ(arrays::stress_ratio(stress)[k], 1. / 3);
        EXPECT_DOUBLE_EQ(arrays::major_stress(stress)[k], 2);
        EXPECT_DOUBLE_EQ(arrays::minor_stress(stress)[k], 1);
        EXPECT_DOUBLE_EQ(arrays::stress_direction(stress)[k], M_PI / 4);
      }
    EXPECT_TRUE(std::isnan(arrays::stress_ratio(stress)[2]));
    EXPECT_EQ(arrays::sizes_over({{3, 4}}, 2), (std::vector<double>{2.5}));
    // A grain's moment over its share of the area is the lattice's stress.
    EXPECT_NEAR(arrays::grain_stress(example_grains(1))[20 * 40 + 20](1, 1), sigma_yy, 1e-12);
  }

  TEST(ComparisonOutput, EmptyFolderHasNoResults)
  {
    const files::Folder folder;
    files::expect_refused({folder.path}, [&] { (void)load_results(folder.path); });
  }
} // namespace
