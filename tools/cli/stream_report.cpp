#include "cli/stream_report.hpp"

#include <fmt/format.h>

#include <hmlfc/stream_info.hpp>

#include "cli/output.hpp"

namespace hmlfc::cli {

io::StreamReport report_on(const StreamFile& file) {
  return {file.size(), file.header(), file.value(file.decoder().statistics())};
}

std::string describe_coding(const StreamHeader& header) {
  return fmt::format("{}, profile {}, {}x{} blocks, window {}, clusters of {}x{}, {}",
                     method_name(header), profile_name(header.profile), header.block_size(),
                     header.block_size(), header.window, header.cluster_rows, header.cluster_cols,
                     header.chroma_format == ChromaFormat::k444 ? "4:4:4" : "4:2:0");
}

std::string size_text(const io::StreamReport& report) {
  std::string text = fmt::format("Size          {} bytes, {:.4f} bpp, 1 : {:.1f}\n",
                                 grouped(report.bytes), report.bits_per_pixel(), report.ratio());
  for (const auto& [name, bytes] : io::named_sections(report.statistics.sections)) {
    if (bytes == 0) continue;
    text += fmt::format("  {:<10} {:>14} bytes {:5.1f} %\n", name, grouped(bytes),
                        100 * static_cast<double>(bytes) / static_cast<double>(report.bytes));
  }
  return text;
}

}  // namespace hmlfc::cli
