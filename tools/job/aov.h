// Channels beside a picture's colour, as the command line asks for them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "src/estimate/estimator.h"
#include "src/integrate/channels.h"
#include "tools/cli/scene_argument.h"

namespace strata::tools::job {

// "steps,evals" and the like; "all" those that such an estimator and ground of such layers have. Throws UsageError for
// another word and for what estimator or ground do not have.
integrate::ChannelSet parse_aovs(const std::string& text, const estimate::EstimatorSettings& estimator,
                                 std::vector<std::string> grounds = {});

// Those of --aov, empty if not given, else those that the picture recorded. Throws UsageError, for several passes too.
integrate::ChannelSet aovs_of(const std::string& typed, const cli::LoadedScene& loaded, int passes);

// "evals,steps".
std::string names_of(const integrate::ChannelSet& aovs);

// All there are, for a help text: their names alone, and a line each with what it is.
std::string all_aov_names();
std::string aov_table();

// Channels of an EXR, in the order of a pixel's values.
std::vector<std::string> aov_channels(const integrate::ChannelSet& aovs, const std::string& prefix = "");

// What an EXR says in its header for programs that read these channels, beside Strata's own.
std::vector<std::pair<std::string, std::string>> aov_header(const integrate::ChannelSet& aovs,
                                                            const std::string& prefix = "");

// What an EXR says of a channel: "nearest: ...".
std::string description_of(const integrate::Channel& channel);

// Whether a picture in false colour is drawn of it as well.
bool is_drawn(const integrate::Channel& channel);

}  // namespace strata::tools::job
