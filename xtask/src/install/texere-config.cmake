# texere::texere is the shared library, texere::texere_static the static one.
get_filename_component(texere_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
if(NOT TARGET texere::texere)
  add_library(texere::texere SHARED IMPORTED)
  set_target_properties(texere::texere PROPERTIES
    IMPORTED_LOCATION "${texere_prefix}/lib/libtexere_c.so.@ABI@"
    IMPORTED_SONAME "libtexere_c.so.@ABI@"
    INTERFACE_INCLUDE_DIRECTORIES "${texere_prefix}/include")
  add_library(texere::texere_static STATIC IMPORTED)
  set_target_properties(texere::texere_static PROPERTIES
    IMPORTED_LOCATION "${texere_prefix}/lib/libtexere_c.a"
    INTERFACE_INCLUDE_DIRECTORIES "${texere_prefix}/include"
    INTERFACE_LINK_LIBRARIES "gcc_s;util;rt;pthread;m;dl")
endif()
