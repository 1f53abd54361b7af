C     TSKTUNE takes any number of pairs: the values that arrive are entries of
C     the history trace, which the test reads.
      PROGRAM TUNING
      INTEGER HOLD
      CALL BUFTUNE('INFO', 'ON')
      CALL TSKTUNE('MAXCPU', 2)
      HOLD = 31
      CALL TSKTUNE('HOLDTIME', HOLD, 'SAMPLE  ', 32)
      CALL TSKTUNE('maxcpu', 1, 'DBACTIVE', 33, 'DBRELEAS', 34,
     &             'STACKSZ', 35000, 'HOLDTIME', 36)
      CALL BUFPRINT
      END
