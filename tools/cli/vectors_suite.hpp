// What the commands of `hmlfc vectors` share.
#pragma once

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "cli/commands.hpp"
#include "vectors/manifest.hpp"

namespace hmlfc::cli {

/// --suite DIR.
void add_suite(CLI::App& app, std::filesystem::path& suite);

/// The manifest of `suite`; a failure (kInput) where it cannot be read.
vectors::Manifest manifest_of(const std::filesystem::path& suite);

/// The vector `id`; a usage failure where there is none.
const vectors::Vector& vector_of(const vectors::Manifest& manifest, const std::string& id);

// The commands; each adds itself to `app`.
void add_vectors_list(CLI::App& app, Task& task);
void add_vectors_explain(CLI::App& app, Task& task);
void add_vectors_show(CLI::App& app, Task& task);
void add_vectors_inspect(CLI::App& app, Task& task);
void add_vectors_lint(CLI::App& app, Task& task);

}  // namespace hmlfc::cli
