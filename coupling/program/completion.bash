#compdef diptych
# diptych: completion of command lines in bash; zsh loads it, too. The words come from `diptych --help`, `diptych COMMAND --help`
# and `diptych explain`.
# SPDX-License-Identifier: LGPL-2.1-or-later
[ -z "$ZSH_VERSION" ] || { autoload -U +X bashcompinit && bashcompinit; }

_diptych()
{
  local program=${COMP_WORDS[0]} command=${COMP_WORDS[1]} word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}
  local key="" words="" help=""
  if [ "$before" = = ]; then # bash divides section/key=value at the sign
    key=${COMP_WORDS[COMP_CWORD-2]}
  elif [ "$word" = = ]; then
    key=$before word=""
  fi
  if [ "$COMP_CWORD" -eq 1 ]; then
    words="--help --version $("$program" --help | sed -n 's/^  \([a-z][a-z-]*\) .*/\1/p')"
  elif [ "$command" = new ]; then
    words=$("$program" new | sed 's/:.*//')
  elif [ -n "$key" ]; then
    words=$("$program" explain "$key" 2>/dev/null | sed -n 's/^  .*\]  \(one of \)\{0,1\}//p' | grep -v ' [0-9F]' | sed 's/,\| or / /g')
  elif [ "$before" = --set ]; then
    compopt -o nospace 2>/dev/null
    words=$("$program" explain | awk '/^[a-z]/ {section = $1} /^  [a-z]/ {print section "/" $1 "="}')
  else
    help=$("$program" "$command" --help 2>/dev/null)
    [ "${before#-}" = "$before" ] ||
      words=$(sed -n "s/^  \(-h,\)\{0,1\}$before [^{]*{\([^}]*\)}.*/\2/p" <<<"$help" | tr , ' ')
    if [ -z "$words" ] && [ "${word#-}" != "$word" ]; then
      words=$(sed -n 's/^  \(-h,\)\{0,1\}\(--[a-z-]*\).*/\2/p' <<<"$help")
    elif [ -z "$words" ]; then
      words=$(sed -n '/^Positionals:/,/^$/s/.*{\([^}]*\)}.*/\1/p' <<<"$help" | tr , ' ')
    fi
  fi
  COMPREPLY=($(compgen -W "$words" -- "$word"))
  if [ ${#COMPREPLY[@]} -eq 0 ] && [ -z "$key" ]; then
    compopt -o filenames 2>/dev/null
    COMPREPLY=($(compgen -f -- "$word"))
  fi
}
complete -F _diptych diptych
# From a folder of functions of zsh: it is called once as what it then defines.
if [ "${funcstack[1]}" = _diptych ]; then _bash_complete -F _diptych; fi
