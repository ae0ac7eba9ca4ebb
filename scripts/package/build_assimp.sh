#!/bin/sh
# Part of make-release and make-root, in their roots while these are made: builds what the tools need of assimp, a static library
# with four importers, from Debian 12's source, in /usr/local/assimp-x86_64 and -aarch64, or, called with wasm, in -wasm.
set -eu

sed 's/^deb /deb-src /; s/trixie/bookworm/' /etc/apt/sources.list > /etc/apt/sources.list.d/sources.list
mkdir /usr/src/assimp
cd /usr/src/assimp
apt-get -q update
apt-get -q source assimp=5.2.5~ds0-1
# The sources ask for it even where it is not used.
: > dracoConfig.cmake

build() {
  arch=$1
  shift
  # Coordinates must not depend on whether a processor multiplies and adds at once.
  flags="-ffp-contract=off -ffunction-sections -fdata-sections -ffile-prefix-map=/usr/src/assimp=. -I$headers/minizip ${more_flags-}"
  ${with-} cmake -S assimp-*/ -B "$arch" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="/usr/local/assimp-$arch" -DBUILD_SHARED_LIBS=OFF \
    -DCMAKE_C_FLAGS="$flags" -DCMAKE_CXX_FLAGS="$flags" -DASSIMP_BUILD_TESTS=OFF -DASSIMP_BUILD_ASSIMP_TOOLS=OFF \
    -DASSIMP_NO_EXPORT=ON -DASSIMP_BUILD_ALL_IMPORTERS_BY_DEFAULT=OFF -DASSIMP_BUILD_OBJ_IMPORTER=ON -DASSIMP_BUILD_STL_IMPORTER=ON \
    -DASSIMP_BUILD_PLY_IMPORTER=ON -DASSIMP_BUILD_GLTF_IMPORTER=ON -DASSIMP_WARNINGS_AS_ERRORS=OFF -DASSIMP_BUILD_ZLIB=OFF \
    -Ddraco_DIR=/usr/src/assimp -DUNZIP_FOUND=ON -DUNZIP_LIBRARIES=minizip "$@"
  cmake --build "$arch"
  cmake --install "$arch"
  cp assimp-*/debian/copyright "/usr/local/assimp-$arch"
  find "/usr/local/assimp-$arch" -name assimpConfig.cmake -exec sed -i '/draco/d' {} +
}

headers=/usr/include
if [ "${1-}" = wasm ]; then
  # Apart from the headers of this system's C library.
  headers=$PWD/include
  mkdir include
  for name in minizip stb utf8 utf8.h zlib.h zconf.h; do ln -s /usr/include/$name include; done
  with=emcmake more_flags="-I$headers -fwasm-exceptions"
  # None of the four importers calls zlib or minizip, which are not there as WebAssembly.
  build wasm -DZLIB_INCLUDE_DIR="$headers" -DZLIB_LIBRARY=m -DUNZIP_LIBRARIES=m
  sed -i '/(draco /d' /usr/local/assimp-wasm/lib/cmake/assimp-*/assimpConfig.cmake
else
  build x86_64
  build aarch64 -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_C_COMPILER=aarch64-linux-gnu-gcc \
    -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++
fi
rm -r /usr/src/assimp
