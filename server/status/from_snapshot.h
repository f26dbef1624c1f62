// The report of a run out of what the frame loop has counted.
#pragma once

#include "server/report.h"
#include "server/status/snapshot.h"

namespace skyig::server::status {

/// All but the buses, which the wire knows.
[[nodiscard]] RunReport make_report(const Facts& facts, const Snapshot& snapshot);

/// What a source counts in its own protocol, beside the packets of CIGI; empty for CIGI sources. What was not
/// taken is "not_taken_" and the reason.
[[nodiscard]] std::vector<NamedCount> source_counts(const Facts& facts, const Snapshot& snapshot,
                                                    std::size_t source);

}  // namespace skyig::server::status
