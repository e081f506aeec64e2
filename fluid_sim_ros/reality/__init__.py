"""A model against real flights: compared by open-loop windows, fitted, excited."""
