# One instruction set of the Debian package and, in the plain one, the package: `cases/build --package` makes all of them, in build
# folders beside each other, the plain one last.
set(PDPLATE_VARIANTS "" CACHE STRING "Instruction sets beside the plain one, for the package")
set(libraries lib/pdplate)
set(share share/pdplate)

add_executable(pdplate cases/package/launcher.cpp)
target_link_libraries(pdplate PRIVATE ${CMAKE_DL_LIBS})
add_dependencies(pdplate pdplate_library)
set_target_properties(pdplate PROPERTIES INSTALL_RPATH "$ORIGIN/../${libraries}")
# As they are built they are installed, so that those of other build folders can be taken too.
set_target_properties(pdplate_library pdplate_files PROPERTIES BUILD_WITH_INSTALL_RPATH ON)
set_target_properties(pdplate_files PROPERTIES INSTALL_RPATH "")

install(TARGETS pdplate RUNTIME DESTINATION bin)
install(TARGETS pdplate_library pdplate_files LIBRARY DESTINATION ${libraries})
foreach(variant ${PDPLATE_VARIANTS})  # the system's loader looks into these folders first
  foreach(library pdplate pdplate_files)
    install(FILES ${PROJECT_BINARY_DIR}/../${variant}/lib${library}.so DESTINATION ${libraries}/glibc-hwcaps/${variant})
  endforeach()
endforeach()

# Cases and documents stand to each other as in the tree, so that their links hold.
install(FILES README.md DESTINATION ${share})
foreach(page plate/theory.md tests/README.md tests/verification/README.md tests/verification/measured_edges_galerkin.md
        tests/verification/measured_factors_growth.md tests/verification/measured_solvers_bonds.md tests/benchmarks/README.md .github/CHANGELOG.md
        .github/CONTRIBUTING.md .github/CITATION.cff .devcontainer/Containerfile)
  cmake_path(GET page PARENT_PATH page_folder)
  install(FILES ${page} DESTINATION ${share}/${page_folder})
endforeach()
install(DIRECTORY plate/theory DESTINATION ${share}/plate FILES_MATCHING PATTERN "*.md")
install(DIRECTORY cases/ DESTINATION ${share}/cases FILES_MATCHING PATTERN "*.toml" PATTERN "*.dxf" PATTERN "*.csv" PATTERN "*.md" PATTERN "*.png"
        PATTERN "*.svg" PATTERN driver EXCLUDE PATTERN runs EXCLUDE PATTERN input EXCLUDE PATTERN studies EXCLUDE PATTERN report EXCLUDE
        PATTERN package EXCLUDE PATTERN python EXCLUDE)
install(FILES cases/python/crack_lengths.py DESTINATION ${share}/cases/python)
install(PROGRAMS cases/studies/slurm.sh DESTINATION ${share}/cases/studies)
install(FILES cases/package/copyright DESTINATION share/doc/pdplate)
if(EXISTS ${PROJECT_SOURCE_DIR}/post/paraview)
  install(DIRECTORY post/paraview DESTINATION ${share}/post FILES_MATCHING PATTERN "*.py" PATTERN "*.md")
endif()
if(PDPLATE_PYTHON)
  set(packages lib/python3/dist-packages/pdplate)
  set_target_properties(pdplate_python PROPERTIES INSTALL_RPATH "$ORIGIN/../../../pdplate")
  install(TARGETS pdplate_python LIBRARY DESTINATION ${packages})
  install(FILES cases/python/pdplate/__init__.py DESTINATION ${packages})
endif()

# What the program prints of itself.
add_custom_command(OUTPUT pdplate.1.gz pdplate.bash pdplate.fish DEPENDS pdplate pdplate_library VERBATIM
                   COMMAND sh -c "./pdplate manual | gzip -9n >pdplate.1.gz && ./pdplate completion bash >pdplate.bash && \
./pdplate completion fish >pdplate.fish")
add_custom_target(pages ALL DEPENDS pdplate.1.gz pdplate.bash pdplate.fish)
install(FILES ${PROJECT_BINARY_DIR}/pdplate.1.gz DESTINATION share/man/man1)
install(FILES ${PROJECT_BINARY_DIR}/pdplate.bash DESTINATION share/bash-completion/completions RENAME pdplate)
install(FILES ${PROJECT_BINARY_DIR}/pdplate.fish DESTINATION share/fish/vendor_completions.d)

set(CPACK_GENERATOR DEB)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT "The PDPlate maintainers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "cracked Mindlin plates in peridynamics")
set(CPACK_PACKAGE_DESCRIPTION "Plates with holes and cracks, under pressure, edge moments or edge shear, static or suddenly applied:
intensity factors of every tip with estimates of their errors, fields, frequencies, and how cracks grow. The program takes the
kernels that the processor can run. With cases to start from, and the Python module pdplate.")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
if(PDPLATE_PYTHON)
  math(EXPR next "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3 (>= 3.${Python3_VERSION_MINOR}~), python3 (<< 3.${next}), python3-numpy")
endif()
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "paraview, python3-matplotlib")
include(CPack)
