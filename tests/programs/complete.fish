# complete.fish FOLDER SCRIPT WORD...: in FOLDER, prints the completions of the last word that SCRIPT offers.
cd $argv[1]
source $argv[2]
complete -C (string join ' ' -- $argv[3..])
