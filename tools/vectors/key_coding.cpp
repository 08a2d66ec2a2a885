#include "vectors/key_coding.hpp"

#include "vectors/header_recipe.hpp"

namespace hmlfc::vectors {

namespace {

// Bits of the code-block style of COD.
unsigned style_from(const Json& names) {
  static const std::map<std::string, unsigned> bits{{"bypass", 1},       {"reset", 2},
                                                    {"terminate", 4},    {"causal", 8},
                                                    {"predictable", 16}, {"segmentation", 32}};
  unsigned style = 0;
  for (const Json& name : names) style |= value_of_word(name, bits);
  return style;
}

const Setters<CodestreamOptions>& setters() {
  using Options = CodestreamOptions;
  static const Setters<Options> all{
      {"style", [](Options& options, const Json& json) { options.style = style_from(json); }},
      {"layers", number(&Options::layers)},
      {"progression", word(&Options::progression,
                           {{"LRCP", 0}, {"RLCP", 1}, {"RPCL", 2}, {"PCRL", 3}, {"CPRL", 4}})},
      {"sop", number(&Options::sop)},
      {"eph", number(&Options::eph)},
      {"code_block",
       [](Options& options, const Json& json) {
         options.block_width = json.at(0);
         options.block_height = json.at(1);
       }},
      {"decompositions", number(&Options::decompositions)},
      {"precinct_log2", number(&Options::precinct_log2)},
  };
  return all;
}

}  // namespace

CodestreamOptions key_coding_from(const Json& json) {
  CodestreamOptions options;
  set_all(options, json, setters(), "an option of key_coding");
  return options;
}

}  // namespace hmlfc::vectors
