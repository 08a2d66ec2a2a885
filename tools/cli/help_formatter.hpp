// The look of --help.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace hmlfc::cli {

/// "  --window N     largest vector component (default 16)": no list of exclusions, no type for
/// flags, the default behind the description.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() { column_width(34); }

  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string& type = option->get_type_name();
    return option->get_type_size() == 0 || type.empty() ? "" : " " + type;
  }

  std::string make_option_desc(const CLI::Option* option) const override {
    std::string text = option->get_description();
    if (option->get_required() && !option->get_positional()) text += " (required)";
    const std::string standard = option->get_default_str();
    return standard.empty() ? text : text + " (default " + standard + ")";
  }

  std::string make_description(const CLI::App* app) const override {
    return app->get_description() + "\n\n";
  }
};

}  // namespace hmlfc::cli
