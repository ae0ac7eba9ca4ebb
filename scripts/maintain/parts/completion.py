"""The completion of pipeline and its commands for bash, zsh and fish, from their --help."""
import re

FUNCTION = r"""
# Prints the words that may stand in place of $1, after the words $2 (a command) and so on; nothing for a
# file's name, - for anything.
_pipeline_words() {
  local word=$1 command=${2-} before=
  shift
  case "$# $command" in
    '0 ') echo '%(commands)s %(words)s' && return ;;
    '1 help') echo '%(commands)s scene stage' && return ;;
  esac
  for before; do
    [ "$before" != -- ] || return 0
  done
  case "$command $before" in
%(values)s    *) case "$command $word" in
%(options)s    esac ;;
  esac
}
"""
# Bash completes names of files where the function leaves COMPREPLY empty (-o default).
BASH = r"""# Completion for bash of pipeline and its commands, made by make-pages.
%(function)s
_pipeline() {
  local word=${COMP_WORDS[COMP_CWORD]} words=("${COMP_WORDS[@]:0:COMP_CWORD}") found IFS=$' \t\n'
  words[0]=${words[0]##*/}
  [ "${words[0]}" != pipeline ] || words=("${words[@]:1}")
  # Bash takes the = of --option=value for a word of its own.
  if [ "$word" = = ]; then
    word=
  elif [ "${words[*]: -1}" = = ]; then
    unset 'words[-1]'
  fi
  found=$(_pipeline_words "$word" "${words[@]}")
  COMPREPLY=()
  if [ "$found" = - ]; then
    compopt +o default 2> /dev/null
  else
    COMPREPLY=($(compgen -W "$found" -- "$word"))
  fi
}

complete -o default -F _pipeline pipeline
# The short names, where they are ours: where pipeline env has been evaluated, or links have been installed.
_pipeline_short_names() {
  local name file
  for name in %(commands)s; do
    file=$(type -P "$name") || continue
    case "$file $(readlink -- "$file")" in
      *libexec/pipeline/*) complete -o default -F _pipeline "$name" ;;
    esac
  done
}
_pipeline_short_names
unset -f _pipeline_short_names
"""
ZSH = r"""#compdef pipeline
# Completion for zsh, made by make-pages.
%(function)s
_pipeline() {
  local before=(${words[2,CURRENT-1]}) found
  if [[ $PREFIX == --*=* ]]; then
    before+=${PREFIX%%%%=*}
    compset -P '*='
  fi
  found=$(_pipeline_words "$PREFIX" $before)
  case $found in
    -) ;;
    '') _files ;;
    *) compadd -- ${=found} ;;
  esac
}
_pipeline "$@"
"""
FISH = r"""# Completion for fish, made by make-pages.
function __pipeline_is
  set -l words (commandline -opc)
  test "$words[2]" = "$argv[1]"
end
complete -c pipeline -n '__pipeline_is ""' -f -a '%(commands)s %(words)s'
complete -c pipeline -n '__pipeline_is help' -f -a '%(commands)s scene stage'
%(lines)s"""
WORDS = "help env --help --version --licenses"  # beside commands
FILES = {
    "bash-completion/completions/pipeline": BASH, "zsh/vendor-completions/_pipeline": ZSH,
    "fish/vendor_completions.d/pipeline.fish": FISH}


def values_of(option):
    """The words after an option: none for a file's name, - for anything; None if it takes no word."""
    if not option.argument:
        return None
    words = " ".join(re.findall(r"(?<![\w.])[a-z0-9]+", option.argument))
    return words or ("" if re.search("FILE|DIR|FOLDER|PATH|SCENE|CONFIG", option.argument) else "-")


def cases(helps):
    """Branches of a shell's case: for the words after an option, and for the options of a command."""
    values, options = "", ""
    for text in helps:
        names = [name for option in text.options for name in option.names]
        options += f"      '{text.name} -'*) echo '{' '.join(names)}' ;;\n"
        for option in text.options:
            if words := values_of(option):
                pattern = " | ".join(f"'{text.name} {name}'" for name in option.names)
                values += f"    {pattern}) echo '{words}' ;;\n"
    return values, options


def fish_lines(helps):
    """A line for each option: its names, and the words that may follow."""
    for text in helps:
        for option in text.options:
            names = "".join(
                f" -l {name[2:]}" if name.startswith("--") else f" -s {name[1:]}" for name in option.names)
            words = values_of(option)
            rest = {None: "", "": " -r -F", "-": " -x"}.get(words, f" -x -a '{words}'")
            yield f"complete -c pipeline -n '__pipeline_is {text.name}'{names}{rest}\n"


def completion(helps):
    """{place in a share: text} for each shell."""
    values, options = cases(helps)
    parts = {
        "values": values, "options": options, "lines": "".join(fish_lines(helps)), "commands": " ".join(
            text.name for text in helps), "words": WORDS}
    parts["function"] = FUNCTION % parts
    return {name: text % parts for name, text in FILES.items()}
