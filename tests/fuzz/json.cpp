// Every reader of JSON from outside: a byte that chooses it, then the text.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "bits/crc32c.hpp"
#include "cli/camera_path.hpp"
#include "conform/claim.hpp"
#include "conform/report.hpp"
#include "conform/stage_trace.hpp"
#include "io/json_text.hpp"
#include "io/rig_files.hpp"
#include "io/rig_text.hpp"
#include "io/transforms.hpp"
#include "target.hpp"
#include "vectors/manifest.hpp"

namespace hmlfc::fuzz {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr io::JsonLimits kSmall{"an input", 4096, 4, 64};
constexpr size_t kLongest = 600;  // of a message, which has at most two values and a path

// Messages go to a terminal.
void check_message(const std::string& message) {
  demand(message.size() <= kLongest, "a message repeats a long text");
  demand(std::ranges::all_of(message, [](char c) { return c >= ' ' && c <= '~'; }),
         "a message has a character that is not printed");
}

template <class T>
bool is_good(const io::IoResult<T>& read) {
  if (!read) check_message(read.error().message);
  return read.has_value();
}

// A folder for what is read from files, gone with the process.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("hmlfc-fuzz-json-" + std::to_string(getpid()))) {
    fs::create_directory(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  fs::path write(const char* name, std::span<const uint8_t> text) const {
    std::ofstream file(path_ / name, std::ios::binary);
    std::ranges::copy(text, std::ostreambuf_iterator<char>(file));
    return path_ / name;
  }

 private:
  fs::path path_;
};

const Folder& folder() {
  static const Folder made;
  return made;
}

size_t depth_of(const Json& json) {
  size_t inside = 0;
  for (const Json& part : json) {
    if (part.is_structured()) inside = std::max(inside, depth_of(part));
  }
  return inside + 1;
}

void read_any(std::span<const uint8_t> text) {
  const auto json = io::parse_json<Json>(text, kSmall);
  if (!json) return check_message(json.error());
  if (json->is_structured()) demand(depth_of(*json) <= kSmall.depth, "a value is too deep");
  demand(*json == Json::parse(text.begin(), text.end()), "a value is another");
  check_message(io::shown_json(*json));
}

void read_rig(std::span<const uint8_t> text) {
  const auto rig = io::parse_rig(text, 2);
  if (!rig) return check_message(rig.error());
  const std::string again = io::rig_text(*rig);
  demand(*rig == io::parse_rig({reinterpret_cast<const uint8_t*>(again.data()), again.size()}, 2),
         "a rig that was written is another");
}

void read_rig_file(std::span<const uint8_t> text) {
  const io::ViewList views{1, 2, {"a.png", "b.png"}};
  is_good(io::read_rig(folder().write("rig.json", text), views, {1, 2, 40, 30, 8}));
}

void read_manifest(std::span<const uint8_t> text) {
  is_good(vectors::read_manifest(folder().write("manifest.json", text).parent_path()));
}

void read_declaration(std::span<const uint8_t> text) {
  is_good(conform::read_dut(folder().write("dut.json", text).string(), "/bin/hmlfc"));
}

void read_claim(std::span<const uint8_t> text) {
  const auto claim = conform::read_claim(folder().write("claim.json", text));
  if (!is_good(claim)) return;
  demand(!conform::claim_difference(*claim, *claim), "a claim differs from itself");
}

void read_report(std::span<const uint8_t> text) {
  const auto report = conform::read_report(folder().write("report.json", text));
  if (is_good(report)) static_cast<void>(conform::to_json(*report));
}

void read_trace(std::span<const uint8_t> text) {
  conform::parse_stages({reinterpret_cast<const char*>(text.data()), text.size()});
}

void read_path(std::span<const uint8_t> text) {
  static const cli::StreamFile stream(HMLFC_FUZZ_STREAM);
  cli::CameraOptions options;
  options.path = folder().write("path.json", text).string();
  try {
    static_cast<void>(cli::cameras_of(options, stream));
  } catch (const cli::Failure& failure) {
    check_message(failure.what());
  }
}

constexpr std::array kReaders{read_any,      read_rig,         read_rig_file,
                              read_manifest, read_declaration, read_claim,
                              read_report,   read_trace,       read_path};

struct Seed {
  uint8_t reader;
  std::string_view text;
};

constexpr std::array kSeeds{
    Seed{0, R"([[[[1,-2,0.5e3,"a\u00e9\n",null,true]]],{"a":{"b":{}}}])"},
    Seed{1, R"({"schema":1,"metres_per_unit":0.5,"positions":[[0,0,0],[1,2e0,-3]],)"
            R"("rotations":[[1,0,0,0]],"intrinsics":[[8,9,1.5,-2],[8,9,1,2]]})"},
    Seed{2, R"({"schema":1,"positions":[[0,0,0],[1,2,3]]})"},
    Seed{2, R"({"fl_x":50,"w":40,"h":30,"camera_angle_x":1,"k1":0,"frames":[)"
            R"({"file_path":"a","transform_matrix":[[1,0,0,0],[0,1,0,0],[0,0,1,0]]},)"
            R"({"file_path":"b.png","transform_matrix":[[1,0,0,5],[0,1,0,0],[0,0,1,0]]}]})"},
    Seed{3, R"({"vectors_version":"1.0.0","stream_version":1,"generator":"g","seed":1,"count":1,)"
            R"("vectors":[{"id":"a/b","group":"a","profile":"main","level":0,"clauses":["HDR-1"],)"
            R"("flags":[],"comment":"","milestone":"errors","input":{"file":"a/b.hmlfc","bytes":9,)"
            R"("sha256":"0"},"expect":{"outcome":"reject","error":"bad_magic","offset":0,)"
            R"("operation":"block","blocks":[{"plane":"Y","view_row":0,"view_col":0,"block_x":0,)"
            R"("block_y":0}]},"base":"a/c","blocks":{"file":"x","sha256":"0"}}]})"},
    Seed{4, R"({"name":"n","command":"a {input} {output}","trace":"t {input} {view_row} )"
            R"({view_col} {plane} {block_x} {block_y}","profile":"main","level":3,"by_block":true,)"
            R"("limits":{"rows":9,"block_log2":[1,2]},"waivers":[{"vector":"a/b","reason":"r"}]})"},
    Seed{4, R"({"name":"n","lines":"'a b' \"c\" {dut}","error_names":true,"comment":""})"},
    Seed{5, R"({"sha256":"","claim":{"results":{"a/b":"pass"},"decoder":{"dut":"d"}}})"},
    Seed{6,
         R"({"vectors_version":"1","manifest_sha256":"0","system":{"program":"p","date":"d",)"
         R"("host":"h","processor":"c","threads":2,"memory_mib":3},"runs":[{"dut":"d",)"
         R"("command":["c"],"profile":"main","level":0,"results":[{"id":"a/b","status":"fail",)"
         R"("difference":{"view_row":0,"view_col":0,"block_x":0,"block_y":0,"x":0,"y":0,)"
         R"("channel":"R","expected":1,"actual":2,"planes":["Y"],"wrong_blocks":1,"blocks":2,)"
         R"("wrong_views":1},"seconds":0.5,"clauses":["A-1"],"milestone":"errors","bytes":9}]}]})"},
    Seed{7, R"({"record":"stage","level":0,"image":[0,1],"plane":"Y","block":[2,3],)"
            R"("stage":"parent","values":[1,-2]})"
            "\n{\"record\":\"field\",\"values\":[[]]}\n"},
    Seed{8, R"([{"position":[0.5,0,0],"look_at":[0,0,9],"fov":40,"focus":1,"aperture":2},)"
            R"({"focus_at":[3,4]}])"},
};

}  // namespace

void run(std::span<const uint8_t> input) {
  InputReader reader(input);
  kReaders[reader.byte() % kReaders.size()](reader.rest());
}

// Texts of each kind, whatever the stream: one of them for each.
std::vector<Bytes> seeds(std::span<const uint8_t> stream) {
  const Seed& seed = kSeeds[crc32c(stream) % kSeeds.size()];
  Bytes bytes{seed.reader};
  bytes.insert(bytes.end(), seed.text.begin(), seed.text.end());
  return {bytes};
}

}  // namespace hmlfc::fuzz
