"""Everything that belongs to this report and to nothing else.

`printed` holds the numbers of the thesis as data, `experiments` says how each comes
about, `scoreboard` compares, `tables` and `figures` show.
"""
