# Constraints of the decode unit: one clock; the part of its period that inputs and outputs spend outside.
# rst_n is synchronous: a path like those of the other inputs.
set hmlfc_period 10.0
set hmlfc_outside 0.3

create_clock -name clk -period $hmlfc_period [get_ports clk]
set_input_delay [expr {$hmlfc_outside * $hmlfc_period}] -clock clk [all_inputs]
set_output_delay [expr {$hmlfc_outside * $hmlfc_period}] -clock clk [all_outputs]
