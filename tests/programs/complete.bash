# complete.bash FOLDER SCRIPT WORD...: in FOLDER, prints the completions of the last word that SCRIPT offers. With
# BASH_COMPLETION, after that package.
cd "$1" || exit
[[ -z ${BASH_COMPLETION-} ]] || source "$BASH_COMPLETION" || exit
source "$2" || exit
compopt() { :; }  # the builtin works only below readline
shift 2
COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMP_LINE="$*" COMP_POINT=${#COMP_LINE}
_roam
printf '%s\n' "${COMPREPLY[@]}"
