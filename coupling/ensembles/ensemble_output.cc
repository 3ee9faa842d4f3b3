// diptych: result files of an ensemble
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/ensembles/ensemble_output.h"

#include <cmath>
#include <sstream>

#include "coupling/ensembles/ensemble_numbers.h"
#include "coupling/numbers/number_json.h"
#include "discrete/files/text_file.h"

namespace diptych::coupling
{
  void write_ensemble_json(const std::string &directory, const Scene &scene, const EnsembleRecord &record)
  {
    nlohmann::json root = nlohmann::json::object();
    NumbersToJson  writer{root, scene.sample.mean_diameter};
    list_numbers(EnsembleDocument{scene, record}, writer);
    discrete::write_text(directory + "/ensemble.json", root.dump(1) + "\n");
  }

  void write_ensemble_csv(const std::string &directory, const Ensemble &ensemble)
  {
    std::ostringstream out;
    out.precision(10);
    out << header_of(ensemble_columns());
    for (const int seed : ensemble.seeds)
      out << ",seed_" << seed;
    out << '\n';
    const auto entry = [&](const double value) {
      out << ',';
      if (std::isfinite(value))
        out << value;
    };
    for (const Quantity &quantity : ensemble.quantities)
      {
        const SampleStatistics &s = quantity.statistics;
        out << quantity.name << ',' << quantity.unit << ',' << s.n;
        for (const double value : {s.mean, s.deviation, s.low, s.high})
          entry(value);
        for (const double value : quantity.values)
          entry(value);
        out << '\n';
      }
    discrete::write_text(directory + "/ensemble.csv", out.str());
  }
} // namespace diptych::coupling
