// diptych: the name of a run's folder
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/studies/run_name.h"

#include "coupling/scene/identity.h"
#include "discrete/choices.h"

namespace diptych::coupling
{
  namespace
  {
    Identity identity_of(const Scene &scene, const StudyCommand command)
    {
      switch (command)
        {
        case StudyCommand::discrete:
          return sample_identity(scene);
          case StudyCommand::run: {
            Identity identity       = member_identity(scene);
            identity["sample/seed"] = std::to_string(scene.sample.seed);
            return identity;
          }
        default:
          return continuum_identity(scene);
        }
    }
  } // namespace

  std::string run_name(const Scene &scene, const StudyCommand command)
  {
    return hexadecimal(digest_of(discrete::name_of(command) + "\n" + text_of(identity_of(scene, command))));
  }
} // namespace diptych::coupling
