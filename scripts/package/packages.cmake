# cpack makes a Debian package of the installed files; cpack --config CPackSourceConfig.cmake, an archive of the sources.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME pipeline)
if(NOT CPACK_PACKAGE_CONTACT)
  # An address that cannot exist; distributors set their own.
  set(CPACK_PACKAGE_CONTACT "The pipeline authors <maintainers@pipeline.invalid>")
endif()
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "raster graphics pipeline as four Unix filters")
set(CPACK_PACKAGE_DESCRIPTION "Model, view, project and zbuf turn a scene of triangles into a picture.
Each reads the text of the stage before it and writes the text of the next,
so that every stage can be looked at, compared, or replaced by a program of
one's own. Other commands show a scene after every stage, fly through it,
explain a triangle's arithmetic, and compare a student's stages with these.
.
The package has one command, pipeline, and the library behind it.")
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/scripts/package/debian_files.cmake)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3 (>= 3.9)")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "ffmpeg, parallel, python3-tk")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "bash-completion, man-db")
# The versions of the shared libraries that the tools use.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)

set(CPACK_SOURCE_GENERATOR TGZ)
set(CPACK_SOURCE_PACKAGE_FILE_NAME pipeline-${PROJECT_VERSION})
# The files that .gitignore names, as regular expressions.
string(REGEX REPLACE "[^/A-Za-z0-9_-]" "." root "${PROJECT_SOURCE_DIR}")
set(CPACK_SOURCE_IGNORE_FILES "/[.]git(/|$)" "^${root}/(build|out)/" "^${root}/(out[.]bmp|z_buffer[.]txt)$" /__pycache__/)
include(CPack)
