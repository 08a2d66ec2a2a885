// Encoding on several machines: the plan, its shards, and what they make.
#pragma once

#include <string_view>

#include "cli/encode_outcome.hpp"

namespace hmlfc::cli {

/// With this a shard begins; a line of JSON and the parts that it lists follow.
inline constexpr std::string_view kShardSign = "hmlfc shard 1\n";

/// Settles the encoding that `options` ask for and writes its plan.
ExitCode write_plan(const EncodeOptions& options);

/// Encodes the parts of options.shard of the plan options.input.
ExitCode encode_shard(const EncodeOptions& options);

/// Puts options.shards together. Failure (kInput): a shard is damaged, of another plan or version,
/// twice there or missing; each missing one is named.
EncodeOutcome assemble_shards(const EncodeOptions& options);

}  // namespace hmlfc::cli
