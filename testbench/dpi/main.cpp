// Runs the SystemVerilog bench golden_blocks to its end.
#include <verilated.h>

#include <memory>

#include "golden_blocks.h"

int main(int argc, char** argv) {
  const auto context = std::make_unique<VerilatedContext>();
  context->commandArgs(argc, argv);
  const auto top = std::make_unique<golden_blocks>(context.get());
  while (!context->gotFinish()) top->eval();
  top->final();
  return 0;
}
