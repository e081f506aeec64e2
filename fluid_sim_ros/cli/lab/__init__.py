"""The subcommands of the laboratory: chart, stability, advise."""
