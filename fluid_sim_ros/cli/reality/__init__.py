"""The subcommands that hold a model against real flights: compare, fit, excite."""
