# complete.zsh FOLDER SCRIPT WORD...: in FOLDER, prints the completions of the last word that SCRIPT offers: presses Tab in
# a terminal, whose compadd also prints each candidate.
zmodload zsh/zpty
zpty shell env TERM=dumb zsh -f -i
zpty -w shell "PROMPT= PS2= ; unsetopt promptcr promptsp; stty -echo; cd ${(q)1}; fpath=(${(q)2:h} \$fpath)"
zpty -w shell 'autoload -Uz compinit; compinit -u -D
  compadd() {
    local -a found
    builtin compadd -A found "$@" 2> /dev/null
    (( $#found )) && print -lr -- "<"$^found">"
    builtin compadd "$@"
  }
  show() { _main_complete; print "<end>"; compstate[insert]=; compstate[list]= }
  zle -C show complete-word show
  bindkey "^I" show
  print -r "<rea""dy>"'
zpty -r shell seen '*<ready>*'
zpty -n -w shell "${(j: :)@[3,-1]}"$'\t'
zpty -r shell seen '*<end>*'
print -r -- $seen | sed -n 's/.*<\(.*\)>.*/\1/p' | sed '/^end$/d'
