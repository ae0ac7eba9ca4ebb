#pragma once

#include <string_view>

/// The program makes the mistakes, and has the habits, that its command line names. The command line is the
/// only writer.

/// Takes a name of mistakes.txt or of habits.txt; false if there is no such name.
bool switch_on(std::string_view name);

/// Whether the program is to make this mistake. Each name stands once in the code: where the mistake is made.
bool mistake(std::string_view name);
bool habit(std::string_view name);

/// All names, a line each, in the order of the two lists.
void print_switches();
