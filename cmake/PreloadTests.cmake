# SPDX-License-Identifier: BSD-3-Clause
# The tests of the preload: programs as others write them, with and without it.

set(preload_tests ${PROJECT_SOURCE_DIR}/tests/preload)

add_test(NAME preload_links_no_ode COMMAND ${preload_tests}/links_test.sh ${preload_output})
