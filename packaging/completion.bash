# Completion of the lampblack command in bash: commands and options as the program's own --help has them, decks and folders by
# their files, and the names of what ships.
_lampblack() {
  local current="${COMP_WORDS[COMP_CWORD]}" before="${COMP_WORDS[COMP_CWORD - 1]}" program="${COMP_WORDS[0]}" command="" word
  local i
  for ((i = 1; i < COMP_CWORD; i++)); do
    word="${COMP_WORDS[i]}"
    if [[ $word != -* ]]; then
      command="$word"
      break
    fi
  done
  COMPREPLY=()
  if [ -z "$command" ]; then
    word="$("$program" --help 2>/dev/null | sed -n -e '/^Subcommands:/,$s/^  \([a-z-][a-z-]*\) .*/\1/p' -e 's/^.*\(--[a-z-][a-z-]*\).*/\1/p')"
    mapfile -t COMPREPLY < <(compgen -W "$word" -- "$current")
    return
  fi
  if [[ $current == -* ]]; then
    word="$("$program" "$command" --help 2>/dev/null | grep -oE -- '--[a-zA-Z][a-zA-Z-]*' | sort -u)"
    mapfile -t COMPREPLY < <(compgen -W "$word" -- "$current")
    return
  fi
  case "$command $before" in
    "cases cases") mapfile -t COMPREPLY < <(compgen -W copy -- "$current") ;;
    "cases copy") mapfile -t COMPREPLY < <(compgen -W "$("$program" cases 2>/dev/null | cut -d ' ' -f 1)" -- "$current") ;;
    "where where") mapfile -t COMPREPLY < <(compgen -W "cases mechanisms python" -- "$current") ;;
    "gas gas" | "mechanism mechanism")
      word="$(ls "$("$program" where mechanisms 2>/dev/null)" 2>/dev/null | grep 'yaml$')"
      mapfile -t COMPREPLY < <(compgen -W "$word" -- "$current"; compgen -f -- "$current") ;;
    *) mapfile -t COMPREPLY < <(compgen -f -- "$current") ;;
  esac
  compopt -o filenames 2>/dev/null
}
complete -F _lampblack lampblack
