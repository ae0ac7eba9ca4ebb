# Called by cpack before it packs: what Debian asks for and a plain installation does not have.
if(NOT CPACK_GENERATOR STREQUAL "DEB")
  return()
endif()
set(prefix "${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr")
set(documents "${prefix}/share/doc/pipeline")
# Debian looks for them under these names.
file(RENAME "${documents}/LICENSE" "${documents}/copyright")
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH, if that is set
file(WRITE "${documents}/changelog" "pipeline (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * The changes are listed in CHANGELOG.md.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
# Tools that are linked statically hold the libraries of the system that built the package.
file(WRITE "${prefix}/share/lintian/overrides/pipeline" "pipeline: embedded-library libpng *
pipeline: embedded-library zlib *
pipeline: shared-library-lacks-prerequisites *
")
file(GLOB compressed "${prefix}/share/man/man*/*" "${documents}/changelog")
foreach(file IN LISTS compressed)
  execute_process(COMMAND gzip -9n ${file} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
