# Does on SPIR-V what drivers would do first, and anew at every start of the program: calls are inlined, variables
# become values, what is computed twice is computed once. None of these passes changes arithmetic.
# cmake -DSPIRV_OPT=program -DFILE=in-and-out.spv -P OptimizeSpirv.cmake
#
# What spirv-opt says of functions that it leaves to the driver, for they return early, is shown if it fails alone.
execute_process(
  COMMAND ${SPIRV_OPT} --scalar-block-layout --eliminate-dead-branches --inline-entry-points-exhaustive --eliminate-dead-functions --eliminate-dead-branches
          --scalar-replacement=0 --ssa-rewrite --eliminate-dead-code-aggressive --redundancy-elimination
          --eliminate-dead-code-aggressive ${FILE} -o ${FILE}
  RESULT_VARIABLE result
  OUTPUT_VARIABLE messages
  ERROR_VARIABLE messages)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${SPIRV_OPT} failed on ${FILE}: ${result}\n${messages}")
endif()
