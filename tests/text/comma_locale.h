#pragma once

#include <clocale>

namespace pipeline {

/// Sets a locale with a decimal comma; false if none is installed.
inline bool set_comma_locale() {
  for (const char* locale : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE"})
    if (std::setlocale(LC_ALL, locale) != nullptr) return true;
  return false;
}

}  // namespace pipeline
