# libpdplate.so: all that computes, in one piece that is compiled with one set of flags. No type of a library that lays out its
# memory by the instruction set (Eigen) crosses its border. OpenMP is the system's: its archive is for programs alone.
find_library(GMP_LIBRARY gmp REQUIRED)
find_library(MPFR_LIBRARY mpfr REQUIRED)
# Archives of SuiteSparse where a shared library can take them in: from version 7 on CHOLMOD's holds METIS with variables of
# threads (relocation R_X86_64_TPOFF32), which it cannot.
include(CheckCSourceCompiles)
set(CMAKE_REQUIRED_FLAGS -fPIC)
set(CMAKE_REQUIRED_LINK_OPTIONS -shared)
set(CMAKE_REQUIRED_LIBRARIES ${SUITESPARSE_ARCHIVES} ${METIS_LIBRARY} m)
check_c_source_compiles("int cholmod_metis(void); int call(void) { return cholmod_metis(); }" PDPLATE_ARCHIVES_IN_LIBRARY)
if(PDPLATE_ARCHIVES_IN_LIBRARY)
  set(suitesparse ${SUITESPARSE_ARCHIVES} ${METIS_LIBRARY})
else()
  set(suitesparse ${UMFPACK_LIBRARY} ${CHOLMOD_LIBRARY})
endif()
add_library(pdplate_door OBJECT cases/python/door.cpp)
target_link_libraries(pdplate_door PRIVATE cases)
target_compile_definitions(pdplate_door PRIVATE PDPLATE_VERSION="${PROJECT_VERSION}" PDPLATE_KERNELS="${PDPLATE_KERNELS}")
add_library(pdplate_library SHARED plate/solve/matrices/standard_streams.cpp)
set(parts geometry plate post fracture runs cases pdplate_door)
if(PDPLATE_PACKAGE)
  list(APPEND parts papers command_line)
  target_sources(command_line PRIVATE cases/package/library_main.cpp)
endif()
foreach(part ${parts})
  target_sources(pdplate_library PRIVATE $<TARGET_OBJECTS:${part}>)
endforeach()
set_target_properties(pdplate_library PROPERTIES OUTPUT_NAME pdplate INSTALL_RPATH "$ORIGIN")
target_link_options(pdplate_library PRIVATE -fopenmp -Wl,--exclude-libs,ALL -Wl,-z,defs -Wl,--wrap=stdout -Wl,--wrap=stderr)
target_link_libraries(pdplate_library PRIVATE ${suitesparse} ${GMP_LIBRARY} ${MPFR_LIBRARY} fmt::fmt ${TOML_LIBRARY} ${MUPARSER_LIBRARY} ${DXFLIB_LIBRARY}
                      ZLIB::ZLIB pugixml::pugixml m
                      pthread ${CMAKE_DL_LIBS})
add_dependencies(pdplate_library pdplate_files)

# The Python module pdplate, of Debian's interpreter.
if(PDPLATE_PYTHON)
  set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Debian's interpreter")
  find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
  find_package(pybind11 REQUIRED)
  set(python_folder ${PROJECT_BINARY_DIR}/python/pdplate)
  pybind11_add_module(pdplate_python MODULE NO_EXTRAS cases/python/module.cpp)
  set_target_properties(pdplate_python PROPERTIES OUTPUT_NAME _door LIBRARY_OUTPUT_DIRECTORY ${python_folder})
  target_include_directories(pdplate_python PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(pdplate_python PRIVATE pdplate_library)
  configure_file(cases/python/pdplate/__init__.py ${python_folder}/__init__.py COPYONLY)
  add_custom_command(TARGET pdplate_python POST_BUILD VERBATIM COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/cases/python/wheel.py
                     ${PROJECT_VERSION} ${python_folder} ${PROJECT_BINARY_DIR}/python $<TARGET_FILE:pdplate_library> $<TARGET_FILE:pdplate_files>)
endif()
