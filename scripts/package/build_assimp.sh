#!/bin/sh
# Part of make-release, in its root while that is made: builds what the tools need of assimp, a static library with four
# importers, from Debian's source, in /usr/local/assimp-x86_64 and /usr/local/assimp-aarch64.
set -eu

sed 's/^deb /deb-src /' /etc/apt/sources.list > /etc/apt/sources.list.d/sources.list
mkdir /usr/src/assimp
cd /usr/src/assimp
apt-get -q update
apt-get -q source assimp
# The sources ask for it even where it is not used.
: > dracoConfig.cmake

build() {
  arch=$1
  shift
  # Coordinates must not depend on whether a processor multiplies and adds at once.
  flags='-ffp-contract=off -ffunction-sections -fdata-sections -ffile-prefix-map=/usr/src/assimp=.'
  cmake -S assimp-*/ -B "$arch" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="/usr/local/assimp-$arch" -DBUILD_SHARED_LIBS=OFF \
    -DCMAKE_C_FLAGS="$flags" -DCMAKE_CXX_FLAGS="$flags -I/usr/include/minizip" -DASSIMP_BUILD_TESTS=OFF -DASSIMP_BUILD_ASSIMP_TOOLS=OFF \
    -DASSIMP_NO_EXPORT=ON -DASSIMP_BUILD_ALL_IMPORTERS_BY_DEFAULT=OFF -DASSIMP_BUILD_OBJ_IMPORTER=ON -DASSIMP_BUILD_STL_IMPORTER=ON \
    -DASSIMP_BUILD_PLY_IMPORTER=ON -DASSIMP_BUILD_GLTF_IMPORTER=ON -DASSIMP_WARNINGS_AS_ERRORS=OFF -DASSIMP_BUILD_ZLIB=OFF \
    -Ddraco_DIR=/usr/src/assimp -DUNZIP_FOUND=ON -DUNZIP_LIBRARIES=minizip "$@"
  cmake --build "$arch"
  cmake --install "$arch"
  find "/usr/local/assimp-$arch" -name assimpConfig.cmake -exec sed -i '/draco/d' {} +
}

build x86_64
build aarch64 -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_C_COMPILER=aarch64-linux-gnu-gcc \
  -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++
rm -r /usr/src/assimp
