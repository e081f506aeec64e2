"""What the node knows and says of how it fares: diagnostics, and the watches behind them."""
