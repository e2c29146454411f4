// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "film/camera_sample.h"
#include "support/law.h"
#include "support/statistics.h"

namespace brume::test {

class TemporaryFolder;

/// Puts the files that a scene refers to beside it.
using WriteFiles = std::function<void(const TemporaryFolder&)>;

/// Quantities that one camera sample contributes to, each a number.
using Tally = std::function<std::vector<double>(const CameraSample&)>;

/// A scene in the scene language and whoever looks at it: its own sensor, or a camera that the
/// language does not have, such as one that integrates over directions.
struct Experiment {
  std::string xml;
  std::shared_ptr<const Camera> camera = nullptr;  // null: the scene's sensor
  WriteFiles write_files = {};
};

/// Means of what `tally` returns over camera samples, through `load_scene` and `PathIntegrator`.
/// What is counted are means over replications of the sampler, which are independent. Pilot runs
/// with other random numbers choose how many, such that each standard error is a little less than
/// `relative_error` of its mean; so the number does not depend on the result.
std::vector<RunningMean> measure(const Experiment& experiment, const Tally& tally,
                                 double relative_error = 0.002);

/// As above, for the mean of the channels of radiance.
RunningMean measure_radiance(const Experiment& experiment, double relative_error = 0.002);

/// Whether the long version of the tests is asked for, by the environment variable BRUME_LONG.
bool runs_long_version();

}  // namespace brume::test
