# INTERFACE target nrd_warnings: the warning flags and the sanitizers every target of the project is built with.
add_library(nrd_warnings INTERFACE)

if(NRD_WARNINGS)
    target_compile_options(nrd_warnings INTERFACE
        -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Woverloaded-virtual
        -Wcast-align -Wformat=2 -Wold-style-cast -Werror=switch -Werror=return-type)
endif()
if(NRD_WERROR)
    target_compile_options(nrd_warnings INTERFACE -Werror)
endif()
if(NRD_SANITIZE)
    target_compile_options(nrd_warnings INTERFACE
        -fsanitize=${NRD_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(nrd_warnings INTERFACE -fsanitize=${NRD_SANITIZE})
endif()
