"""What is on record: the printed numbers, the certificates, and the verdicts."""
