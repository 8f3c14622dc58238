# Installs the build into a fresh prefix, then configures, builds and runs the outside project.
set(work "${BUILD_DIR}/install-test")
set(prefix "${work}/prefix")
file(REMOVE_RECURSE "${work}")

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "failed (${status}): ${command}\n${output}")
  endif()
  set(run_output "${output}" PARENT_SCOPE)
endfunction()

run("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${prefix}")
run("${CMAKE_COMMAND}" -S "${SOURCE_DIR}" -B "${work}/build" -G "${GENERATOR}"
    "-DCMAKE_BUILD_TYPE=Release" "-DCMAKE_PREFIX_PATH=${prefix}"
    "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${CXX_LAUNCHER}"
    "-DBUCKENS_WANTED_VERSION=${VERSION}")
run("${CMAKE_COMMAND}" --build "${work}/build")
run("${CMAKE_COMMAND}" -E chdir "${work}" "${work}/build/outside")
message(STATUS "${run_output}")

# examples/cpp as they are installed, with the numbers they print against what is known.
set(examples "${prefix}/share/buckens/examples/cpp")
run("${CMAKE_COMMAND}" -S "${examples}" -B "${work}/examples" -G "${GENERATOR}"
    "-DCMAKE_BUILD_TYPE=Release" "-DCMAKE_PREFIX_PATH=${prefix}"
    "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${CXX_LAUNCHER}")
run("${CMAKE_COMMAND}" --build "${work}/examples")

# expect(text pattern least most): the number that the pattern's group matches.
function(expect pattern least most)
  if(NOT run_output MATCHES "${pattern}")
    message(FATAL_ERROR "nothing matches \"${pattern}\" in:\n${run_output}")
  endif()
  if(CMAKE_MATCH_1 LESS least OR CMAKE_MATCH_1 GREATER most)
    message(FATAL_ERROR "${CMAKE_MATCH_1} is not within ${least} … ${most}:\n${run_output}")
  endif()
endfunction()

run("${work}/examples/pendulum" "${work}/falling-rod")
message(STATUS "${run_output}")
# √(3 g/L) = 5.424942; within the step in which the rod passes its lowest place the speed is that to
# 1e-5, and the method's error is of the order (w h)².
expect("speed ([0-9.]+) exact 5.424942" 5.42485 5.42500)
expect("difference (-?[0-9.e+-]+) rad" 0 0)

run("${work}/examples/custom_force")
message(STATUS "${run_output}")
expect("speed ([0-9.]+) exact 13.29" 13.2965 13.2974)
# v̇ = g − F/m − c/m v² from 15.45 m/s at 4 s down to 4 m/s takes 0.3346 s, to a step or two.
expect("stopped 1 at ([0-9.]+) s" 4.333 4.338)

run("${work}/examples/parameter_loop")
message(STATUS "${run_output}")
# sag P L³/(3 E I); frequency of a clamped beam, from zero crossings read to a step in 10 periods,
# with rotary inertia and shear, which the formula leaves out.
expect("diameter 0.008 sag ([0-9.e+-]+) exact" 1.035e-2 1.038e-2)
expect("diameter 0.010 sag ([0-9.e+-]+) exact" 4.240e-3 4.249e-3)
expect("diameter 0.012 sag ([0-9.e+-]+) exact" 2.044e-3 2.050e-3)
expect("diameter 0.008 .* m frequency ([0-9.]+) exact 22.59" 22.4 22.8)

if(EXISTS "${prefix}/bin/buckens")
  # What a program has recorded is a run directory like any other.
  run("${prefix}/bin/buckens" view "${work}/falling-rod" -o "${work}/falling-rod.html")
  run("${prefix}/bin/buckens" version)
  if(NOT run_output MATCHES "${VERSION}")
    message(FATAL_ERROR "the installed program names another version than ${VERSION}: ${run_output}")
  endif()
endif()
