"""The report on the thesis: what it prints, recomputed and shown.

`record` holds the printed numbers as data, the certificates and the verdicts; `search` finds
certificates.  `studies` computes, `scoreboard` compares with the print, `tables`, `figures`
and `explorers` show.
"""
