# Script: nrd_frontend.glsl compiles in every GLSL stage, with every encoding, and as HLSL.
#   cmake -DGLSLANG=... -DINCLUDES=... -DWORK=... [-DSELF_TEST=1] -P check_languages.cmake
cmake_minimum_required(VERSION 3.25)
file(MAKE_DIRECTORY "${WORK}")

set(glsl "#version 460\n#extension GL_GOOGLE_include_directive : require\n#include \"nrd_frontend.glsl\"\n")
set(hlsl "#include \"nrd_frontend.glsl\"\n")
if(SELF_TEST)
    string(APPEND glsl "float broken(float x) { return frac(x); }\n")  # frac is HLSL's
    string(APPEND hlsl "float broken(float x) { return fract(x); }\n") # fract is GLSL's
endif()

# Appends to "failures" what does not compile; flags may be several.
function(check name source)
    file(WRITE "${WORK}/${name}.txt" "${source}")
    execute_process(COMMAND "${GLSLANG}" --quiet --target-env vulkan1.2 "-I${INCLUDES}" ${ARGN}
        -o "${WORK}/${name}.spv" "${WORK}/${name}.txt" RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
    if(NOT result EQUAL 0)
        list(APPEND failures ${name})
        set(failures "${failures}" PARENT_SCOPE)
        set(log "${log}${name}:\n${text}\n" PARENT_SCOPE)
    endif()
endfunction()

set(failures "")
set(log "")
set(layout_tesc "layout(vertices = 3) out;")
set(layout_tese "layout(triangles) in;")
set(layout_geom "layout(points) in; layout(points, max_vertices = 1) out;")
set(stages vert tesc tese geom frag comp rgen rchit rmiss)
foreach(stage IN LISTS stages)
    check(glsl-${stage} "${glsl}${layout_${stage}}\nvoid main() {}\n" -S ${stage})
endforeach()
foreach(normal RANGE 4)
    check(normal-${normal} "${glsl}void main() {}\n" -S comp -DNRD_NORMAL_ENCODING=${normal})
endforeach()
foreach(roughness RANGE 2)
    check(roughness-${roughness} "${glsl}void main() {}\n" -S comp -DNRD_ROUGHNESS_ENCODING=${roughness})
endforeach()
# Unused functions are parsed and checked as well.
check(hlsl-comp "${hlsl}[numthreads(8, 8, 1)] void main() {}\n" -D -D__HLSL_VERSION=2021 -S comp -e main)
check(hlsl-frag "${hlsl}float4 main() : SV_Target { return float4(0, 0, 0, 0); }\n"
    -D -D__HLSL_VERSION=2021 -S frag -e main)

list(LENGTH failures failure_num)
if(SELF_TEST AND NOT failure_num EQUAL 19)
    message(FATAL_ERROR "a front end that only one language knows passed: ${failure_num} of 19 were refused\n${log}")
elseif(NOT SELF_TEST AND failures)
    message(FATAL_ERROR "does not compile:\n${log}")
endif()
