#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fails when a work that a comment or a document cites by author and year, as in Veach 1997, Heitz
# and d'Eon 2014 or Walter et al. 2007, has no entry in docs/references.bib, and prints where. The
# key of an entry is the first author's surname in lower-case ASCII and the year; a letter may follow.
set -euo pipefail
cd "$(dirname "$0")/.."

git ls-files --cached --others --exclude-standard -- \
  '*.h' '*.cpp' '*.md' '*.sh' '*.py' '*.txt' '*.cmake' '*.xml' |
  perl -CSDA -Mutf8 -e '
    my %known;
    open my $bib, "<", "docs/references.bib" or die "docs/references.bib: $!\n";
    while (<$bib>) { $known{$1} = 1 if /^@\w+\{(\w+?)[a-z]?,/ }

    my $name = qr/\p{Lu}[\p{L}\x{27}]*\p{Ll}[\p{L}\x{27}-]*/;
    my $second = qr/(?:\p{Ll}\x{27})?$name/;
    my $gap = qr{(?:\ |\n\s*(?://+|\#)?\s*)};  # a citation may go on in the next line
    my $missing = 0;
    while (my $file = <STDIN>) {
      chomp $file;
      open my $in, "<", $file or next;
      my $text = do { local $/; <$in> } // "";
      while ($text =~ /($name)(?:$gap et$gap al\.|(?:,$gap$second)*$gap and$gap$second)?,?$gap\(?((?:18|19|20)\d\d)\b(?![:.]\d)/gx) {
        my ($author, $year, $before) = ($1, $2, substr($text, 0, $-[0]));
        my ($line_start) = $before =~ /([^\n]*)\z/;
        next unless $file =~ /\.md$/ || $line_start =~ m{//|#|<!--};
        (my $key = lc $author) =~ tr/áàâäçéèêëíìîïñóòôöúùûü\x{27}-/aaaaceeeeiiiinoooouuuu/d;
        next if $known{"$key$year"};
        my $line = 1 + ($before =~ tr/\n//);
        print "$file:$line: $author $year: no entry \"$key$year\" in docs/references.bib\n";
        $missing = 1;
      }
    }
    exit $missing;
  '
