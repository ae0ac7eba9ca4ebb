# Called by cpack before it packs: adds files that Debian requires and a plain installation lacks.
if(NOT CPACK_GENERATOR STREQUAL "DEB")
  return()
endif()
set(prefix "${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr")
set(documents "${prefix}/share/doc/pipeline")
# Debian looks for the license under this name, and in this form.
file(READ "${documents}/LICENSE" license)
file(REMOVE "${documents}/LICENSE")
string(REPLACE "\n\n" "\n.\n" license "${license}")
string(REPLACE "\n" "\n " license "${license}")
string(REGEX REPLACE "^.*Copyright [(]c[)] ([^\n]*)\n [.]\n(.*)\n " "\
Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: pipeline
Comment: The programs contain parts of other packages; THIRD-PARTY beside this file has their licenses.

Files: *
Copyright: \\1
License: Expat
\\2
" copyright "${license}")
file(WRITE "${documents}/copyright" "${copyright}")
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # from SOURCE_DATE_EPOCH, if it is set
file(WRITE "${documents}/changelog" "pipeline (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * The changes are listed in CHANGELOG.md.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
# The reasons are comments in the file, so that `lintian --show-overrides` shows them.
file(WRITE "${prefix}/share/lintian/overrides/pipeline"
"# Each picture starts four programs: linked statically, one starts in two thirds of the time. A distribution that prefers
# shared libraries configures with -DPIPELINE_STATIC_TOOLS=OFF; dpkg-shlibdeps then finds them.
pipeline: embedded-library libpng *
pipeline: embedded-library zlib *
# Static and position-independent: lintian takes it for a library.
pipeline: shared-library-lacks-prerequisites *
")
file(GLOB compressed "${prefix}/share/man/man*/*" "${documents}/changelog")
foreach(file IN LISTS compressed)
  execute_process(COMMAND gzip -9n ${file} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
