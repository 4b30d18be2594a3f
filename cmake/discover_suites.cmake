# Run after a test program is linked: writes the file SUITES, by which ctest knows each suite of PROGRAM as a test with the label
# LABEL. So what a suite shares (a device, its pipelines) is made once, not for each test. Suites of many tests start first. What
# happened to each test is left in the folder REPORTS.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE ";" " " listed "${listed}")
string(REPLACE "\n" ";" lines "${listed}")
set(suites)
foreach(line ${lines})
  if(line MATCHES "^([A-Za-z0-9_/]+)\\.")
    set(suite ${CMAKE_MATCH_1})
    list(APPEND suites ${suite})
    set(tests_of_${suite} 0)
  elseif(suite AND line MATCHES "^  ")
    math(EXPR tests_of_${suite} "${tests_of_${suite}} + 1")
  endif()
endforeach()

set(written)
foreach(suite ${suites})
  string(REPLACE "/" "-" report ${suite})
  string(APPEND written
    "add_test([=[${suite}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}.*]=] --gtest_brief=1 [=[--gtest_output=xml:${REPORTS}/${report}.xml]=])\n"
    "set_tests_properties([=[${suite}]=] PROPERTIES LABELS ${LABEL} COST ${tests_of_${suite}} TIMEOUT 600)\n")
endforeach()
file(WRITE ${SUITES} "${written}")
