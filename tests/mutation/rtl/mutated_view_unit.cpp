// A mutated view unit, or its DMA alone, as the one of the bench.
#include HMLFC_MUTATED_HEADER

#include "mutated_unit.hpp"
#include "view/verilated_view.hpp"
#include "view/view_units.hpp"

namespace hmlfc::tb {
namespace {

constexpr uint64_t kAnswerSeed = 5;

// The DMA alone shows the port on which it reads samples.
template <class Model>
constexpr bool kIsDma = requires(Model model) {
  model.fetch_arvalid;
};

template <class Model>
std::unique_ptr<ViewUnit> make_unit(const UnitParameters& parameters, Oracle& oracle, unsigned) {
  if constexpr (kIsDma<Model>) {
    return std::make_unique<VerilatedDma<Model>>(parameters, oracle, kAnswerSeed,
                                                 mutants_plusarg());
  } else {
    return std::make_unique<VerilatedView<Model>>(parameters, mutants_plusarg());
  }
}

// units.py has these parameters as well.
constexpr bool kDma = kIsDma<HMLFC_MUTATED>;
constexpr UnitParameters kParameters{kDma ? 1U : 2U, 12, 8, 4};

std::vector<ViewMaker> only(bool made) {
  if (!made) return {};
  return {{kParameters, &make_unit<HMLFC_MUTATED>}};
}

}  // namespace

std::string& mutants_plusarg() {
  static std::string plusarg = "+mutants=0";
  return plusarg;
}

std::vector<ViewMaker> view_units() { return only(!kDma); }

std::vector<ViewMaker> view_dmas() { return only(kDma); }

ViewMaker faulty_view_dma() { return {}; }

std::vector<std::unique_ptr<Check>> checks(const std::filesystem::path&) {
  return test_checks(kDma ? "ViewDma" : "ViewUnit");
}

const std::vector<RtlFault>& view_faults() {
  static const std::vector<RtlFault> none;
  return none;
}

}  // namespace hmlfc::tb
